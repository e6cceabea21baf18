// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/bench/limit/instructions.hpp"
#include "tests/bench/measure/process.hpp"
#include "tests/bench/measure/rounds.hpp"

namespace regulus::detail::bench {
namespace {

using ::testing::HasSubstr;

TEST(Spread, OfAnEvenNumberOfValuesInterpolates) {
  const Spread spread = spread_of({4, 1, 3, 2});
  EXPECT_EQ(spread.median, 2.5);
  EXPECT_EQ(spread.low, 1.75);
  EXPECT_EQ(spread.high, 3.25);
}

/// A clock that only the contenders advance.
thread_local double now = 0;
double told() { return now; }

TEST(Rounds, CompareWithTheReferenceOfTheSameRound) {
  // The machine becomes slower from run to run; a ratio within a round hardly changes.
  double pace = 1;
  const auto takes = [&pace](double seconds) {
    return [&pace, seconds] { now += seconds * (pace *= 1.01); };
  };
  const Contender contenders[] = {{"reference", 1, takes(1)}, {"three at once", 3, takes(6)}};
  RoundOptions options;
  options.rounds = 5;
  options.slice = 0.5;
  options.clock = told;
  const auto timings = compare(contenders, options);
  ASSERT_EQ(timings.size(), 2U);
  EXPECT_EQ(timings[0].ratio.median, 1);
  EXPECT_NEAR(timings[1].ratio.median, 2, 1e-3);
  EXPECT_GT(timings[1].seconds.high, timings[1].seconds.low);
}

TEST(Rounds, RepeatAPassUntilASliceIsFull) {
  int passes = 0;
  const Contender contenders[] = {{"short", 1, [&] {
                                     ++passes;
                                     now += 0.125;
                                   }}};
  RoundOptions options;
  options.rounds = 1;
  options.slice = 1;
  options.clock = told;
  const auto timings = compare(contenders, options);
  EXPECT_EQ(timings[0].seconds.median, 0.125);
  EXPECT_GE(passes, 16) << "a slice to find out, a slice that counts";
}

TEST(Process, ReturnsOutputAndExitCode) {
  const ProcessRun run =
      run_process({"sh", "-c", "echo $REGULUS_WORD; echo e >&2; exit 3"}, {"REGULUS_WORD=word"});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.output, HasSubstr("word"));
  EXPECT_THAT(run.output, HasSubstr("e\n"));
}

TEST(Process, ThatDoesNotExistHasExitCodeMinusOne) {
  EXPECT_EQ(run_process({"no-such-program-anywhere"}).exit_code, -1);
}

TEST(BoundOperations, AreTwoForASumAndSixForAProductOfIntervals) {
  ProgramBuilder builder({"x", "y"}, {"k"});
  const auto x = builder.input(0), y = builder.input(1);
  builder.output(builder.add(builder.multiply(x, y), builder.multiply(builder.point(0), x)));
  EXPECT_EQ(bound_operations(std::move(builder).finish()), 2U + 6U + 2U);
}

TEST(CountInstructions, TellsBoundsFromSelectionsAndMovesInOneSymbol) {
  const char* listing =
      "0000000000000000 <left_product_1>:\n"
      "   0:\tvmovapd (%rdi),%zmm0\n"
      "   6:\tvmulpd {rd-sae},%zmm1,%zmm0,%zmm2\n"
      "   c:\tvfmadd213pd {ru-sae},%zmm1,%zmm0,%zmm2\n"
      "  12:\tvmovapd %zmm3,%zmm2{%k1}\n"
      "  18:\tvblendmpd %zmm3,%zmm2,%zmm4{%k1}\n"
      "  1e:\tvaddpd %ymm3,%ymm2,%ymm4\n"
      "0000000000000100 <matrix_1>:\n"
      " 100:\tvaddpd {ru-sae},%zmm3,%zmm2,%zmm4\n";
  const VectorInstructions counts = count_instructions(listing, "left_product");
  EXPECT_EQ(counts.arithmetic, 2U);
  EXPECT_EQ(counts.selection, 2U);
  EXPECT_EQ(counts.moves, 1U);
  EXPECT_EQ(counts.bytes, 0x1eU);
}

}  // namespace
}  // namespace regulus::detail::bench
