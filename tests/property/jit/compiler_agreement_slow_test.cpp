// SPDX-License-Identifier: GPL-3.0-or-later
// All ways from a text to code give the same results. Every operation of a pack is a fixed sequence
// of correctly rounded ones, so enclosures agree bit for bit, and a compiler that folds, merges or
// reorders them is detected. The test prints the times but does not judge them.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>

#include "codegen/kernel/jit/jit.hpp"
#include "runtime/kernel/buffers.hpp"
#include "runtime/kernel/call.hpp"
#include "tests/support/random_kernel_text.hpp"
#include "tests/support/spawned_compiler.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail {
namespace {

constexpr int kRounds = 200;

/// The portable packs need a hundred instructions for one instruction of the others.
int operations_for(Isa isa) { return isa == Isa::kPortable ? 40 : 300; }

struct Inputs {
  explicit Inputs(std::mt19937_64& random)
      : boxes(test::kRandomVariables), points(test::kRandomPoints) {
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
  BoxBatch boxes;
  PointRows points;
};

/// Compares all defined lanes; returns how many there were.
int expect_equal_results(const CheckedKernel& one, const CheckedKernel& other, Inputs& inputs) {
  OutputBatch out_one(test::kRandomOutputs), out_other(test::kRandomOutputs);
  const auto call = [&inputs](const CheckedKernel& kernel, OutputBatch& out) {
    return kernel.call(kernel.functions().matrix, inputs.boxes.data(), inputs.points.data(),
                       out.data());
  };
  const unsigned undefined = call(one, out_one);
  EXPECT_EQ(undefined, call(other, out_other));
  int compared = 0;
  for (std::size_t lane = 0; lane < REGULUS_LANES; ++lane) {
    if (undefined >> lane & 1u) continue;
    ++compared;
    for (std::size_t e = 0; e < out_one.size(); ++e) {
      const Interval x = out_one.get(e, lane), y = out_other.get(e, lane);
      EXPECT_EQ(std::memcmp(&x, &y, sizeof x), 0)
          << e << ": [" << x.lo << ", " << x.hi << "] and [" << y.lo << ", " << y.hi << "]";
    }
  }
  return compared;
}

class CompilerAgreement : public testing::TestWithParam<Isa> {};

TEST_P(CompilerAgreement, InProcessAndSpawnedCompilersMakeTheSameEnclosures) {
  const Isa isa = GetParam();
  if (!supported(isa)) GTEST_SKIP() << "this processor lacks " << name(isa);
  const test::TemporaryDirectory directory;
  EmittedKernel emitted;
  emitted.symbol = test::kRandomKernelSymbol;
  emitted.source = test::RandomKernelText(operations_for(isa), 821).text();
  const CompiledKernel compiled = compile_kernel(emitted, {isa, false, {}});
  const CheckedKernel in_process(*compiled.kernel());

  int compilers = 0;
  for (const char* compiler : {"g++", "clang++-22", "clang++"}) {
    if (!test::is_installed(compiler)) continue;
    ++compilers;
    const auto library =
        test::compile_with_spawned(compiler, emitted.source, isa, directory.path());
    const auto* functions =
        static_cast<const regulus_kernel*>(library.symbol(emitted.symbol.c_str()));
    ASSERT_NE(functions, nullptr);
    const CheckedKernel spawned(*functions);
    std::mt19937_64 random(7);
    int compared = 0;
    for (int round = 0; round < kRounds; ++round) {
      Inputs inputs(random);
      compared += expect_equal_results(in_process, spawned, inputs);
      ASSERT_FALSE(HasFailure()) << compiler;
    }
    EXPECT_GT(compared, kRounds) << compiler;
  }
  EXPECT_GT(compilers, 0);
}

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, CompilerAgreement, testing::ValuesIn(kAllIsas),
                         [](const auto& isa) { return std::string(name(isa.param)); });

double nanoseconds_per_box(const regulus_kernel* functions) {
  const CheckedKernel kernel(*functions);
  std::mt19937_64 random(7);
  Inputs inputs(random);
  OutputBatch out(test::kRandomOutputs);
  double best = 1e9;
  for (int round = 0; round < 20; ++round) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 200; ++i)
      (void)kernel.call(kernel.functions().matrix, inputs.boxes.data(), inputs.points.data(),
                        out.data());
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    best = std::min(best, time.count() / (200 * REGULUS_LANES));
  }
  return best;
}

TEST(CompileLatency, IsPrintedForAKernelOfRealisticSize) {
  const test::TemporaryDirectory directory;
  const Isa isa = best_isa();
  EmittedKernel emitted;
  emitted.symbol = test::kRandomKernelSymbol;
  emitted.source = test::RandomKernelText(821, 1).text();
  const CompileOptions options{isa, true, directory.path() / "cache"};
  std::printf("%-28s %8s %8s\n", "821 operations", "ms", "ns/box");
  for (int i = 0; i < 3; ++i) {
    const CompiledKernel compiled = compile_kernel(emitted, options);
    const CompileReport& r = compiled.report();
    std::printf("%-28s %8.2f %8.1f\n", ("in process, " + std::string(compiled.cache())).c_str(),
                1e3 * r.total_seconds, nanoseconds_per_box(compiled.kernel()));
    if (r.cache == CacheUse::kMiss)
      std::printf(
          "  opening %.1f, front end %.1f, optimiser %.1f, code generation %.1f, loading %.2f\n",
          1e3 * r.open_compiler_seconds, 1e3 * r.front_end_seconds, 1e3 * r.optimiser_seconds,
          1e3 * r.code_generation_seconds, 1e3 * r.load_seconds);
  }
  for (const char* compiler : {"g++", "clang++-22"}) {
    if (!test::is_installed(compiler)) continue;
    const auto library =
        test::compile_with_spawned(compiler, emitted.source, isa, directory.path());
    std::printf("%-28s %8.2f %8.1f\n", ("spawned " + std::string(compiler)).c_str(),
                1e3 * library.seconds(),
                nanoseconds_per_box(
                    static_cast<const regulus_kernel*>(library.symbol(emitted.symbol.c_str()))));
  }
  EXPECT_EQ(compile_kernel(emitted, options).cache(), "hit");
}

}  // namespace
}  // namespace regulus::detail
