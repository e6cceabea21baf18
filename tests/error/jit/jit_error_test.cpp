// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "codegen/kernel/jit/cache/object_cache.hpp"
#include "codegen/kernel/jit/clang_compiler.hpp"
#include "codegen/kernel/jit/jit.hpp"
#include "codegen/kernel/jit/kernel_compilation.hpp"
#include "tests/support/cache_entries.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail {
namespace {

using testing::HasSubstr;

const CompileOptions kNoCache{Isa::kPortable, false, {}};
const char* const kSound = "extern \"C\" int answer() { return 42; }";

/// Returns the error of a text that must not compile.
CompileError refusal_of(const std::string& text) {
  try {
    (void)compile_text(text, kNoCache);
  } catch (const CompileError& error) {
    return error;
  }
  throw std::logic_error("compiled");
}

TEST(JitError, ATextWithAMistakeGivesTheDiagnosticsAndTheText) {
  const std::string text = "extern \"C\" int f() {\n  return undeclared;\n}\n";
  const CompileError error = refusal_of(text);
  EXPECT_THAT(error.diagnostics(), HasSubstr("kernel.cpp:2:10: error: "));
  EXPECT_THAT(error.diagnostics(), HasSubstr("'undeclared'"));
  EXPECT_THAT(error.what(), HasSubstr(error.diagnostics()));
  EXPECT_EQ(error.text(), text);
}

TEST(JitError, ATextSeesNoFileOfTheMachine) {
  for (const char* header : {"<cmath>", "<stddef.h>", "\"/etc/passwd\"", "\"../etc/passwd\""})
    EXPECT_THAT(refusal_of("#include " + std::string(header) + "\n").diagnostics(),
                HasSubstr("file not found"))
        << header;
}

TEST(JitError, ATextCallsNothingOfTheMachine) {
  EXPECT_THAT(refusal_of("extern \"C\" int system(const char*);\n"
                         "extern \"C\" int f() { return system(\"true\"); }\n")
                  .what(),
              HasSubstr("'system' is not defined"));
}

TEST(JitError, ATextCannotRunWhenItIsLoaded) {
  EXPECT_THAT(refusal_of("extern \"C\" { volatile int started; }\n"
                         "__attribute__((constructor)) void start() { started = 1; }\n")
                  .what(),
              HasSubstr("would have to run when loaded"));
}

TEST(JitError, AKernelThatTheTextDoesNotDefineIsMissed) {
  EmittedKernel kernel;
  kernel.source = kSound;
  for (const char* symbol : {"absent", "answer"}) {  // a function is smaller than a kernel
    kernel.symbol = symbol;
    try {
      (void)compile_kernel(kernel, kNoCache);
      ADD_FAILURE() << symbol;
    } catch (const CompileError& error) {
      EXPECT_THAT(error.what(), HasSubstr("no kernel '" + kernel.symbol + "'"));
    }
  }
}

TEST(JitError, AKernelOfAnotherAbiIsRefused) {
  EmittedKernel kernel;
  kernel.symbol = "old_kernel";
  kernel.source =
      "#include \"runtime/kernel/abi.hpp\"\n"
      "extern \"C\" { extern const regulus_kernel old_kernel;\n"
      "const regulus_kernel old_kernel = {REGULUS_KERNEL_ABI + 1}; }\n";
  EXPECT_THROW((void)compile_kernel(kernel, kNoCache), CompileError);
}

TEST(JitError, FlagsTheCompilerDoesNotKnowAreReported) {
  Compilation compilation = kernel_compilation(kSound, Isa::kPortable);
  compilation.flags.push_back("-fno-such-flag");
  const CompiledObject compiled = ClangCompiler().compile(compilation);
  EXPECT_EQ(compiled.object, "");
  EXPECT_THAT(compiled.diagnostics, HasSubstr("-fno-such-flag"));
}

TEST(JitError, PassesTheOptimiserDoesNotKnowAreReported) {
  Compilation compilation = kernel_compilation(kSound, Isa::kPortable);
  compilation.passes = "no-such-pass";
  const CompiledObject compiled = ClangCompiler().compile(compilation);
  EXPECT_EQ(compiled.object, "");
  EXPECT_THAT(compiled.diagnostics, HasSubstr("no-such-pass"));
}

class BadCacheTest : public testing::Test {
 protected:
  test::TemporaryDirectory directory_;
  std::filesystem::path path_ = directory_.path() / "cache";
  CompileOptions options_{Isa::kPortable, true, path_};

  [[nodiscard]] std::filesystem::path entry() const { return test::cache_entries(path_).at(0); }

  /// Expects that the text is compiled again for that reason, and the entry is sound afterwards.
  void expect_recompiled(const char* reason) const {
    const MachineCode again = compile_text(kSound, options_);
    EXPECT_EQ(again.report().cache, CacheUse::kMiss);
    EXPECT_THAT(again.report().cache_note, HasSubstr(reason));
    EXPECT_EQ(reinterpret_cast<int (*)()>(again.symbol("answer"))(), 42);
    const MachineCode third = compile_text(kSound, options_);
    EXPECT_EQ(third.report().cache, CacheUse::kHit);
    EXPECT_EQ(third.report().cache_note, "");
  }
};

TEST_F(BadCacheTest, ADamagedEntryIsCompiledAgain) {
  (void)compile_text(kSound, options_);
  std::ofstream(entry(), std::ios::trunc) << "damaged";
  expect_recompiled("is damaged");
}

TEST_F(BadCacheTest, AnEntryThatCannotBeLoadedIsCompiledAgain) {
  (void)compile_text(kSound, options_);
  const std::string key = entry().stem().string();
  ASSERT_EQ(ObjectCache(path_).write(key, std::string(100, 'x')), "");
  expect_recompiled("not relocatable ELF");
}

TEST_F(BadCacheTest, ADirectoryThatIsNotSafeIsNotUsed) {
  std::filesystem::create_directory(path_);
  std::filesystem::permissions(path_, std::filesystem::perms::all);
  const MachineCode code = compile_text(kSound, options_);
  EXPECT_EQ(code.report().cache, CacheUse::kOff);
  EXPECT_THAT(code.report().cache_note, HasSubstr("is writable by other users"));
  EXPECT_EQ(reinterpret_cast<int (*)()>(code.symbol("answer"))(), 42);
  EXPECT_TRUE(std::filesystem::is_empty(path_));
}

}  // namespace
}  // namespace regulus::detail
