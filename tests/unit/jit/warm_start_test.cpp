// SPDX-License-Identifier: GPL-3.0-or-later
// A process loads only what it has not loaded before. So each of these tests runs in a new process
// that has done nothing else. The environment names their common directory.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <vector>

#include "codegen/kernel/jit/jit.hpp"
#include "runtime/machine/self_test_kernel.hpp"
#include "tests/support/process_maps.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail {
namespace {

constexpr const char* kDirectoryVariable = "REGULUS_TEST_CACHE";

CompileOptions options() { return {best_isa(), true, std::getenv(kDirectoryVariable)}; }

CompiledKernel compile() { return compile_kernel(machine::self_test_kernel(), options()); }

/// Returns true if the code rounds outward.
bool works(const CompiledKernel& code) {
  return !machine::check_self_test(*code.kernel(), options().isa);
}

/// Prints on stderr what was used; the exit status is 0 if the code works.
[[noreturn]] void compile_and_exit() {
  const CompiledKernel code = compile();
  const bool sound = works(code);
  const bool compiler = test::is_mapped("LLVM") || test::is_mapped("clang");
  std::fprintf(stderr, "cache %s, compiler %s, %.2f ms\n",
               std::string(name(code.report().cache)).c_str(), compiler ? "loaded" : "not loaded",
               1e3 * code.report().total_seconds);
  std::_Exit(sound ? 0 : 1);
}

/// Compiles in three processes at once; the exit status is the number of failed processes.
[[noreturn]] void compile_at_once_and_exit() {
  std::vector<pid_t> children;
  for (int i = 0; i < 3; ++i) {
    const pid_t child = ::fork();
    if (child == 0) {
      const CompiledKernel code = compile();
      std::_Exit(works(code) && code.report().cache_note.empty() ? 0 : 1);
    }
    children.push_back(child);
  }
  int failures = 0;
  for (const pid_t child : children) {
    int status = 1;
    ::waitpid(child, &status, 0);
    failures += status != 0;
  }
  std::_Exit(failures);
}

class WarmStart : public testing::Test {
 protected:
  WarmStart() {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    if (std::getenv(kDirectoryVariable)) return;  // the new process of a test
    directory_.emplace();
    ::setenv(kDirectoryVariable, directory_->path().c_str(), 1);
  }
  ~WarmStart() override {
    if (directory_) ::unsetenv(kDirectoryVariable);
  }

  std::optional<test::TemporaryDirectory> directory_;
};

TEST_F(WarmStart, LoadsNothingOfTheCompiler) {
  EXPECT_EXIT(compile_and_exit(), testing::ExitedWithCode(0), "cache miss, compiler loaded");
  EXPECT_EXIT(compile_and_exit(), testing::ExitedWithCode(0), "cache hit, compiler not loaded");
}

TEST_F(WarmStart, FollowsOnProcessesThatCompiledTheSameKernelAtOnce) {
  EXPECT_EXIT(compile_at_once_and_exit(), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(compile_and_exit(), testing::ExitedWithCode(0), "cache hit, compiler not loaded");
}

}  // namespace
}  // namespace regulus::detail
