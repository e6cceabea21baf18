// SPDX-License-Identifier: GPL-3.0-or-later
// What is read as a kernel is what a C++ compiler makes of the same text, bit for bit.
#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <span>

#include "regulus/codegen/jit/clang_compiler.hpp"
#include "regulus/codegen/jit/jit.hpp"
#include "regulus/codegen/jit/kernel_compilation.hpp"
#include "regulus/kernel/buffers.hpp"
#include "regulus/kernel/call.hpp"
#include "regulus/kernel/self_test.hpp"
#include "support/random_kernel_text.hpp"

namespace regulus::codegen {
namespace {

class Reading : public testing::TestWithParam<Isa> {
 protected:
  void SetUp() override {
    if (!supported(GetParam())) GTEST_SKIP() << "this processor lacks " << name(GetParam());
  }

  [[nodiscard]] LoadedObject compile_as_cxx(const std::string& text) const {
    const CompiledObject compiled =
        ClangCompiler().compile_any(kernel_compilation(text, GetParam()));
    EXPECT_EQ(compiled.diagnostics, "");
    return load_object(std::as_bytes(std::span(compiled.object)), kernel_externals());
  }
};

void fill(BoxBatch& boxes, PointRows& points, std::mt19937_64& random) {
  std::uniform_real_distribution<double> centre(-2, 2), exponent(-40, 0);
  for (std::size_t lane = 0; lane < REGULUS_LANES; ++lane) {
    for (std::size_t v = 0; v < boxes.size(); ++v) {
      const double mid = centre(random), radius = std::exp2(exponent(random));
      boxes.set(v, lane,
                random() % 16 == 0 ? Interval{-0.0, 0.0} : Interval{mid - radius, mid + radius});
    }
    for (std::size_t p = 0; p < points.size(); ++p)
      points.set(
          p, lane,
          random() % 16 == 0 ? 0.0 : std::ldexp(std::round(std::ldexp(centre(random), 20)), -20));
  }
}

/// Compares what two kernels make of random boxes. Returns how many lanes were defined.
int compare(const regulus_kernel& a, const regulus_kernel& b, std::mt19937_64& random) {
  int compared = 0;
  for (int round = 0; round < 50; ++round) {
    BoxBatch boxes(test::kRandomVariables);
    PointRows points(test::kRandomPoints);
    fill(boxes, points, random);
    OutputBatch out_a(test::kRandomOutputs), out_b(test::kRandomOutputs);
    const auto call = [&](const regulus_kernel& kernel, OutputBatch& out) {
      return Kernel(kernel).call(kernel.matrix, boxes.data(), points.data(), out.data());
    };
    const unsigned undefined = call(a, out_a);
    EXPECT_EQ(undefined, call(b, out_b));
    for (std::size_t lane = 0; lane < REGULUS_LANES; ++lane) {
      if (undefined >> lane & 1u) continue;
      ++compared;
      for (std::size_t e = 0; e < out_a.size(); ++e) {
        const Interval x = out_a.get(e, lane), y = out_b.get(e, lane);
        EXPECT_EQ(std::memcmp(&x, &y, sizeof x), 0)
            << "output " << e << ": [" << x.lo << ", " << x.hi << "] and [" << y.lo << ", " << y.hi
            << "]";
      }
    }
  }
  return compared;
}

EmittedKernel random_kernel(int operations, std::uint64_t seed) {
  EmittedKernel emitted;
  emitted.symbol = test::kRandomKernelSymbol;
  emitted.source = test::RandomKernelText(operations, seed).text();
  return emitted;
}

TEST_P(Reading, MakesTheEnclosuresThatClangMakesOfTheText) {
  std::mt19937_64 random(31);
  int compared = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const EmittedKernel emitted = random_kernel(GetParam() == Isa::kPortable ? 40 : 250, seed);
    const CompiledKernel read = compile_kernel(emitted, {GetParam(), false, {}});
    ASSERT_EQ(read.report().not_read, "");
    const LoadedObject object = compile_as_cxx(emitted.source);
    const auto* as_cxx =
        static_cast<const regulus_kernel*>(object.find(emitted.symbol, sizeof(regulus_kernel)));
    ASSERT_NE(as_cxx, nullptr);
    EXPECT_EQ(read.kernel()->rounding, as_cxx->rounding);
    compared += compare(*read.kernel(), *as_cxx, random);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  EXPECT_GT(compared, 300);
}

/// With the operation at a random place exchanged for another.
EmittedKernel changed(EmittedKernel kernel, std::mt19937_64& random) {
  std::vector<std::size_t> sums;
  for (std::size_t at = 0; (at = kernel.source.find(" + ", at)) != std::string::npos; ++at)
    sums.push_back(at);
  kernel.source[sums.at(random() % sums.size()) + 1] = '-';
  return kernel;
}

TEST_P(Reading, MakesTheSameOfATextWithFunctionsThatAreKnown) {
  std::mt19937_64 random(32);
  CompiledParts parts;
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    EmittedKernel emitted = random_kernel(650, seed);  // in four functions
    for (int edit = 0; edit < 3; ++edit, emitted = changed(emitted, random)) {
      const CompiledKernel whole = compile_kernel(emitted, {GetParam(), false, {}});
      const CompiledKernel completed = compile_kernel(emitted, {GetParam(), false, {}, &parts});
      EXPECT_EQ(completed.report().functions_compiled, edit == 0 ? 4u : 1u);
      EXPECT_EQ(completed.report().functions_known, edit == 0 ? 0u : 3u);
      compare(*whole.kernel(), *completed.kernel(), random);
      ASSERT_FALSE(HasFailure()) << "seed " << seed << ", edit " << edit;
    }
  }
}

TEST_P(Reading, TakesTheSelfTestTheWayKernelsTake) {
  const MachineCode code = compile_text(kSelfTestSource, {GetParam(), false, {}});
  EXPECT_EQ(code.report().not_read, "");
}

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, Reading, testing::ValuesIn(kAllIsas),
                         [](const auto& isa) { return std::string(name(isa.param)); });

}  // namespace
}  // namespace regulus::codegen
