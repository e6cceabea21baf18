// SPDX-License-Identifier: GPL-3.0-or-later
// Tests growing sets whose least singular value is known.
#include "runtime/witness/least_witness.hpp"

#include <gtest/gtest.h>

#include "runtime/witness/point_witness.hpp"
#include "tests/support/fixture_kernel.hpp"

namespace regulus::detail::test {
namespace {

/// det = a − x²/2, or its negative.
class Bowl : public FixtureKernel {
 public:
  explicit Bowl(bool negative = false) : FixtureKernel(2, 1, 2, 2), negative_(negative) {}
  [[nodiscard]] Values matrix(const Values& v) const override {
    const Interval half = v[0] * Interval(0.5);
    return negative_ ? Values{half, v[1], Interval(1.0), v[0]}
                     : Values{v[1], half, v[0], Interval(1.0)};
  }

 private:
  bool negative_;
};

/// Returns the problem with x in ±1 and a in 1 ± tolerance.
Problem tolerant(const FixtureKernel& kernel, double tolerance) {
  Problem problem;
  problem.kernel = kernel.get();
  problem.outer = {Interval(-1, 1), Interval(1 - tolerance, 1 + tolerance)};
  problem.inner = {problem.outer[0], problem.outer[1]};
  return problem;
}

class LeastWitnessOfEitherSign : public testing::TestWithParam<bool> {};

TEST_P(LeastWitnessOfEitherSign, IsTheToleranceAtWhichACornerIsSingular) {
  const Bowl kernel(GetParam());
  const Problem low = tolerant(kernel, 0), high = tolerant(kernel, 0.75);
  LeastWitness search(high, {}, Growth::between(0, low, 0.75, high), false);
  ASSERT_TRUE(search.search(10, 4, nullptr));
  EXPECT_NEAR(search.found()->value, 0.5, 1e-9);

  const Problem above = tolerant(kernel, 0.50390625);
  const Result proved = prove_singularity(above, {}, search.points_at(0.50390625));
  EXPECT_EQ(proved.verdict, Verdict::kSingularity);
  const Problem below = tolerant(kernel, 0.49609375);
  EXPECT_NE(prove_singularity(below, {}, search.points_at(0.50390625)).verdict,
            Verdict::kSingularity);
}

INSTANTIATE_TEST_SUITE_P(LeastWitness, LeastWitnessOfEitherSign, testing::Bool(),
                         testing::PrintToStringParamName());

TEST(LeastWitness, IsNotFoundWhereThereIsNone) {
  const Bowl kernel;
  const Problem low = tolerant(kernel, 0), high = tolerant(kernel, 0.25);
  LeastWitness search(high, {}, Growth::between(0, low, 0.25, high), false);
  EXPECT_FALSE(search.search(10, 8, nullptr));
  EXPECT_TRUE(search.points_at(0.25).empty());
}

TEST(LeastWitness, IsTheLeastDeterminantWhereTheThresholdGrows) {
  const Bowl kernel;
  Problem problem = tolerant(kernel, 0.125);
  problem.alpha = Interval(1.0);
  LeastWitness search(problem, {}, Growth::between(0, problem, kInfinity, problem), true);
  ASSERT_TRUE(search.search(10, 4, nullptr));
  EXPECT_NEAR(search.found()->value, 0.375, 1e-9);
  problem.alpha = Interval(0.376);
  EXPECT_EQ(prove_singularity(problem, {}, search.points_at(0.376)).reason,
            Reason::kSmallDeterminant);
}

TEST(LeastWitness, StopsWhenInterrupted) {
  const Bowl kernel;
  const Problem low = tolerant(kernel, 0), high = tolerant(kernel, 0.75);
  LeastWitness search(high, {}, Growth::between(0, low, 0.75, high), false);
  const std::atomic<bool> interrupt{true};
  EXPECT_FALSE(search.search(10, 100, &interrupt));
}

TEST(Growth, IsLinearBetweenItsTwoValues) {
  const Growth growth(1, {Interval(-1, 1)}, 3, {Interval(-3, 5)});
  EXPECT_EQ(growth.at(2, 0, 0), -2);
  EXPECT_EQ(growth.at(2, 0, 1), 3);
  EXPECT_EQ(growth.at(3, 0, 0.5), 1);
}

}  // namespace
}  // namespace regulus::detail::test
