// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/compilation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "codegen/kernel/jit/clang_compiler.hpp"
#include "codegen/kernel/jit/kernel_compilation.hpp"
#include "regulus/floating_point_flags.hpp"

namespace regulus::detail {
namespace {

Compilation small_compilation() {
  return {
      {"source.cpp", "text"}, {{"a.hpp", "first"}, {"b.hpp", "second"}}, {"-x", "-y"}, "passes"};
}

TEST(ObjectKey, DependsOnEveryPart) {
  std::vector<Compilation> all(14, small_compilation());
  all[1].source.text = "texts";
  all[2].source.name = "sources.cpp";
  all[3].headers[0].text = "First";
  all[4].headers[1].name = "c.hpp";
  all[5].headers.pop_back();
  all[6].flags[1] = "-z";
  all[7].flags.pop_back();
  all[8].passes = "";
  all[9].flags = {"-x-y"};
  all[10].headers = {{"a.hpp", "firstb.hppsecond"}};
  all[11].flags = {"-y", "-x"};
  all[12].source = {"source", ".cpptext"};
  all[13].isa = "avx2";
  std::set<std::string> keys;
  for (const Compilation& compilation : all) keys.insert(object_key(compilation, "compiler"));
  keys.insert(object_key(all[0], "compiler 2"));
  EXPECT_EQ(keys.size(), all.size() + 1);
  EXPECT_EQ(object_key(all[0], "compiler"), object_key(small_compilation(), "compiler"));
}

TEST(KernelCompilation, HasTheFloatingPointFlagsAndThoseOfTheInstructionSet) {
  for (const Isa isa : kAllIsas) {
    const auto flags = kernel_compilation("", isa).flags;
    for (const char* flag : kFloatingPointFlags) EXPECT_EQ(std::ranges::count(flags, flag), 1);
    for (const char* flag : compile_flags(isa)) EXPECT_EQ(std::ranges::count(flags, flag), 1);
  }
}

TEST(ClangCompiler, MakesTheSameObjectEveryTime) {
  const ClangCompiler compiler;
  const Compilation compilation = kernel_compilation(
      "#include \"runtime/kernel/pack.hpp\"\n"
      "extern \"C\" int f(int x) { return x + 1; }",
      Isa::kPortable);
  const CompiledObject first = compiler.compile(compilation);
  EXPECT_EQ(first.diagnostics, "");
  EXPECT_NE(first.object, "");
  EXPECT_EQ(compiler.compile(compilation).object, first.object);
}

TEST(ClangCompiler, IsIdentifiedByItsVersionWithoutBeingOpened) {
  const std::string identity = ClangCompiler().identity();
  EXPECT_TRUE(identity.starts_with("Clang ")) << identity;
  EXPECT_EQ(identity.find("absent"), std::string::npos) << identity;
}

}  // namespace
}  // namespace regulus::detail
