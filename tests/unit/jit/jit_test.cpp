// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/jit.hpp"

#include <gtest/gtest.h>

#include <cfenv>
#include <cstring>

#include "codegen/kernel/jit/clang_compiler.hpp"
#include "codegen/kernel/jit/kernel_compilation.hpp"
#include "runtime/kernel/buffers.hpp"
#include "runtime/kernel/call.hpp"
#include "tests/support/process_maps.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail {
namespace {

/// Makes a kernel of two variables x, y and one entry k of K: k·x + y·y, sin(x), x/y.
EmittedKernel small_kernel() {
  EmittedKernel kernel;
  kernel.symbol = "small_kernel";
  kernel.source = R"(
#include "runtime/kernel/abi.hpp"
#include "runtime/kernel/pack.hpp"
namespace {
unsigned matrix(const double* boxes, const double* points, double* out, const void*) {
  using namespace regulus::pack;
  unsigned undefined = 0;
  const I x = load(boxes, 0);
  const I y = load(boxes, 1);
  store(out, 0, point(points, 0) * x + y * y);
  store(out, 1, sin(x));
  store(out, 2, div(x, y, undefined));
  return undefined;
}
}  // namespace
extern "C" const regulus_kernel small_kernel = {
    REGULUS_KERNEL_ABI, regulus::pack::kRounding, 2, 2, 1, 1, 0, 0, matrix, nullptr, nullptr,
    nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, "small"};
)";
  return kernel;
}

class JitTest : public testing::TestWithParam<Isa> {
 protected:
  void SetUp() override {
    if (!supported(GetParam())) GTEST_SKIP() << "this processor lacks " << name(GetParam());
  }

  test::TemporaryDirectory directory_;
  CompileOptions options_{GetParam(), true, directory_.path() / "cache"};
};

TEST_P(JitTest, CompiledCodeEnclosesWhatItComputes) {
  const CompiledKernel compiled = compile_kernel(small_kernel(), options_);
  const CheckedKernel kernel(*compiled.kernel());
  EXPECT_EQ(compiled.kernel()->rounding, required_rounding(GetParam()));
  IntervalRows boxes(2), out(3);
  PointRows points(1);
  points.set_all_lanes(0, 3.0);
  boxes.set_all_lanes(0, {0.5, 1.0});
  boxes.set_all_lanes(1, {-2.0, 1.0});
  boxes.set(1, 3, {2.0, 4.0});
  const unsigned undefined =
      kernel.call(kernel.functions().matrix, boxes.data(), points.data(), out.data());
  EXPECT_EQ(undefined, kAllLanes & ~(1u << 3));  // y contains 0 in the others
  EXPECT_LE(out.get(0, 0).lo, 1.5 - 2.0);
  EXPECT_GE(out.get(0, 0).hi, 3.0 + 4.0);
  EXPECT_LE(out.get(1, 3).lo, 0x1.eaee8744b05efp-2);  // below sin(1/2)
  EXPECT_GE(out.get(1, 3).hi, 0x1.aed548f090cefp-1);  // above sin(1)
  EXPECT_LE(out.get(2, 3).lo, 0.125);
  EXPECT_GE(out.get(2, 3).hi, 0.5);
}

TEST_P(JitTest, PassesTheRoundingSelfTest) {
  for (int i = 0; i < 2; ++i) {  // compiled, and from the cache
    EXPECT_EQ(rounding_self_test(options_), std::nullopt);
    EXPECT_EQ(text_rounding_self_test(options_), std::nullopt);
  }
}

TEST_P(JitTest, TheSecondTimeTheCodeComesFromTheCache) {
  const CompiledKernel first = compile_kernel(small_kernel(), options_);
  EXPECT_EQ(first.cache(), "miss");
  EXPECT_EQ(first.cache_note(), "");
  EXPECT_GT(first.report().front_end_seconds, 0);
  const CompiledKernel second = compile_kernel(small_kernel(), options_);
  EXPECT_EQ(second.cache(), "hit");
  EXPECT_EQ(second.report().front_end_seconds, 0);
  EXPECT_STREQ(second.kernel()->identity, "small");
  EXPECT_NE(first.kernel(), second.kernel());
}

TEST_P(JitTest, AnotherTextIsAnotherEntry) {
  (void)compile_kernel(small_kernel(), options_);
  EmittedKernel other = small_kernel();
  other.source += " ";
  EXPECT_EQ(compile_kernel(other, options_).cache(), "miss");
}

TEST_P(JitTest, WithoutTheCacheNothingIsWritten) {
  options_.use_cache = false;
  const CompiledKernel compiled = compile_kernel(small_kernel(), options_);
  EXPECT_EQ(compiled.cache(), "off");
  EXPECT_EQ(compiled.cache_note(), "");
  EXPECT_FALSE(std::filesystem::exists(options_.cache_directory));
}

TEST_P(JitTest, TheCallersRoundingModeIsKeptAndHasNoInfluence) {
  const ClangCompiler compiler;
  const std::string text = small_kernel().source;
  const Compilation compilation = kernel_compilation(text, GetParam());
  const std::string nearest = compiler.compile(compilation).object;
  ASSERT_EQ(std::fesetround(FE_UPWARD), 0);
  const std::string upward = compiler.compile(compilation).object;
  const int mode = std::fegetround();
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(mode, FE_UPWARD);
  EXPECT_NE(nearest, "");
  EXPECT_EQ(upward, nearest);
}

/// What LLVM's linker does with a text, and what it must not do.
TEST_P(JitTest, GivesEverySegmentOfATextItsOwnRights) {
  const MachineCode code = compile_text(R"(extern "C" {
int function() { return 7; }
extern const int constant[2];
const int constant[2] = {1, 2};
extern int (*const table[2])();
int (*const table[2])() = {nullptr, function};
int variable = 3;
alignas(64) char zero[5000];
static int hidden() { return 5; }
int use() { return hidden() + variable; }
}
)",
                                        options_);
  const auto rights = [&code](const char* name) {
    return test::range_of(code.symbol(name)).value().rights;
  };
  EXPECT_EQ(rights("function"), "r-xp");
  EXPECT_EQ(rights("constant"), "r--p");
  EXPECT_EQ(rights("table"), "r--p");
  EXPECT_EQ(rights("variable"), "rw-p");
  EXPECT_EQ(rights("zero"), "rw-p");
  const auto* table = static_cast<int (*const*)()>(code.symbol("table", 16));
  ASSERT_NE(table, nullptr);
  EXPECT_EQ(table[0], nullptr);
  EXPECT_EQ(table[1](), 7);
  const auto* zero = static_cast<const char*>(code.symbol("zero", 5000));
  ASSERT_NE(zero, nullptr);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(zero) % 64, 0U);
  EXPECT_EQ(std::string(zero, 5000), std::string(5000, '\0'));
  EXPECT_EQ(code.symbol("zero", 5001), nullptr);
  EXPECT_EQ(code.symbol("hidden"), nullptr);
  EXPECT_EQ(code.symbol("absent"), nullptr);
}

TEST_P(JitTest, ATextCallsFunctionsOfTheProcessHoweverFarAway) {
  const MachineCode code = compile_text(
      "extern \"C\" { void* memcpy(void*, const void*, unsigned long);\n"
      "void* copy(void* a, const void* b, unsigned long n) { return memcpy(a, b, n); }\n"
      "void* (*address())(void*, const void*, unsigned long) { return memcpy; } }\n",
      options_);
  const auto copy =
      reinterpret_cast<void* (*)(void*, const void*, std::size_t)>(code.symbol("copy"));
  ASSERT_NE(copy, nullptr);
  char to[] = "....";
  EXPECT_EQ(copy(to, "copy", 4), to);
  EXPECT_STREQ(to, "copy");
  const auto address =
      reinterpret_cast<void* (*(*)())(void*, const void*, std::size_t)>(code.symbol("address"));
  ASSERT_NE(address, nullptr);
  EXPECT_EQ(reinterpret_cast<void*>(address()), reinterpret_cast<void*>(&std::memcpy));
}

TEST_P(JitTest, CodeLivesAsLongAsOneCopy) {
  const void* address = nullptr;
  {
    std::optional<MachineCode> first = compile_text(small_kernel().source, options_);
    const MachineCode second = *first;
    first.reset();
    address = second.symbol("small_kernel");
    EXPECT_EQ(test::range_of(address).value().rights, "r--p");
  }
  const auto range = test::range_of(address);
  EXPECT_TRUE(!range || range->rights != "r--p");
}

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, JitTest, testing::ValuesIn(kAllIsas),
                         [](const auto& isa) { return std::string(name(isa.param)); });

}  // namespace
}  // namespace regulus::detail
