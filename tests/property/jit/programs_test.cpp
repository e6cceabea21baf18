// SPDX-License-Identifier: GPL-3.0-or-later
// A pack program gives the same bounds, bit for bit, as machine code of its parts, on the vector
// machine, and as C++ text that Clang compiles in process.
#include "codegen/kernel/jit/jit.hpp"
#include "runtime/machine/self_test_kernel.hpp"
#include "tests/property/cpp/compiled_kernels.hpp"

namespace regulus::detail {
namespace {

using test::Answer;
using test::Case;

class Programs : public testing::TestWithParam<Isa> {
 protected:
  void SetUp() override {
    if (!supported(GetParam())) GTEST_SKIP() << "this processor lacks " << name(GetParam());
  }
  [[nodiscard]] CompileOptions options() const { return {GetParam(), false, {}}; }

  static unsigned part_length(std::uint64_t seed) {
    constexpr unsigned kPartLengths[] = {1, 3, 7, 64};
    return kPartLengths[seed % 4];
  }

  /// Compares both kernels of a module on random boxes. Counts the lanes that are defined.
  void compare(const Module& module, const regulus_kernel& a, const regulus_kernel& b, int cases) {
    test::RandomSource random(77);
    for (const test::NamedField& field : test::kFields) {
      const Program& program = module.find(field.name)->program;
      const std::size_t outputs = program.outputs.size();
      for (int i = 0; i < cases; ++i) {
        const Case test_case = test::random_case(random, program);
        const Answer x = test::ask(a, a.*field.function, outputs, test_case);
        const Answer y = test::ask(b, b.*field.function, outputs, test_case);
        ASSERT_TRUE(test::same_answers(x, y, outputs)) << to_text(program);
        defined_ += std::popcount(kAllLanes & ~x.undefined);
      }
    }
  }

  int defined_ = 0;
};

TEST_P(Programs, AsMachineCodeAreWhatTheVectorMachineMakesOfThem) {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const Module module = test::random_module(seed);
    const machine::PackKernel program = select(module, part_length(seed));
    const CompiledKernel compiled = compile_kernel(program, options());
    const machine::MachineKernel interpreted(program, GetParam());
    EXPECT_EQ(compiled.kernel()->rounding, interpreted.get()->rounding);
    compare(module, *compiled.kernel(), *interpreted.get(), 20);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  EXPECT_GT(defined_, 3000);
}

TEST_P(Programs, AsMachineCodeAreWhatClangMakesOfTheirText) {
  for (std::uint64_t seed = 101; seed <= 104; ++seed) {
    const Module module = test::random_module(seed);
    EmitOptions emit_options;
    emit_options.operations_per_part = part_length(seed);
    const CompiledKernel text = compile_kernel(emit(module, emit_options), options());
    const CompiledKernel compiled = compile_kernel(select(module, part_length(seed)), options());
    EXPECT_EQ(compiled.kernel()->rounding, text.kernel()->rounding);
    EXPECT_STREQ(compiled.kernel()->identity, text.kernel()->identity);
    compare(module, *compiled.kernel(), *text.kernel(), 20);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  EXPECT_GT(defined_, 500);
}

TEST_P(Programs, AreTheSameOfPartsThatWereCompiledWithOthers) {
  const Module first = test::random_module(5);
  Module second = first;
  const Module source = test::random_module(6);
  const Function& other = *source.find("pose");
  for (Function& function : second.functions)
    if (function.name == other.name) function = other;
  PartStore parts;
  CompileOptions with_parts = options();
  with_parts.parts = &parts;
  (void)compile_kernel(select(first), with_parts);
  const CompiledKernel completed = compile_kernel(select(second), with_parts);
  EXPECT_EQ(completed.report().parts.compiled, 1U);
  EXPECT_GT(completed.report().parts.known, 2U);
  const machine::MachineKernel interpreted(select(second), GetParam());
  compare(second, *completed.kernel(), *interpreted.get(), 20);
}

TEST_P(Programs, PassTheRoundingSelfTestInEveryEngine) {
  EXPECT_EQ(rounding_self_test(options()), std::nullopt);
  EXPECT_EQ(text_rounding_self_test(options()), std::nullopt);
  const machine::MachineKernel interpreted(machine::self_test_kernel(), GetParam());
  EXPECT_EQ(machine::check_self_test(*interpreted.get(), GetParam()), std::nullopt);
}

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, Programs, testing::ValuesIn(kAllIsas),
                         [](const auto& isa) { return std::string(name(isa.param)); });

}  // namespace
}  // namespace regulus::detail
