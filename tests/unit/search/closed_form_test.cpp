// SPDX-License-Identifier: GPL-3.0-or-later
// Tests what the search decides by a determinant in closed form, on kernels with a known one.
#include <gtest/gtest.h>

#include <random>

#include "runtime/evaluation/batch.hpp"
#include "tests/support/function_kernel.hpp"

namespace regulus::detail::test {
namespace {

constexpr auto kClosedFormLeaves = static_cast<std::size_t>(Rule::kClosedForm);

Settings closed_form() {
  Settings settings;
  settings.method = Method::kClosedForm;
  return settings;
}

/// det = x² − 2x + c, written so that its natural enclosure is wide.
class Parabola : public FunctionKernel {
 public:
  explicit Parabola(double c) : FunctionKernel(1, 1, 1, value(c)) { with_determinant(value(c)); }

 private:
  static Function value(double c) {
    return [c](const Values& x) { return Values{x[0] * x[0] - 2.0 * x[0] + c}; };
  }
};

Values slope_of_parabola(const Values& x) { return {2.0 * x[0] - 2.0}; }

Interval bounds(FunctionKernel& kernel, const std::vector<Interval>& box) {
  const Problem problem = problem_over(kernel, box);
  const Settings settings = closed_form();
  const RowStructure none;
  Batch batch(problem, settings, none);
  batch.clear();
  batch.load(0, box);
  batch.seal(1);
  const ConstIntervalVector det = kernel.functions().determinant_derivatives != nullptr
                                      ? batch.monotone_determinant()
                                      : batch.natural_determinant();
  return {det.lower(0, 0), det.upper(0, 0)};
}

TEST(ClosedForm, NeedsAKernelThatHasIt) {
  const FunctionKernel kernel(1, 1, 1, [](const Values& x) { return Values{x[0]}; });
  const auto fault = find_fault(problem_over(kernel, {{1, 2}}), closed_form());
  ASSERT_TRUE(fault);
  EXPECT_NE(fault->find("closed form"), std::string::npos) << *fault;
}

TEST(ClosedForm, IsAsWideAsItsNaturalEnclosureWithoutDerivatives) {
  Parabola kernel(0);
  EXPECT_EQ(bounds(kernel, {{3, 5}}), Interval(-1, 19));
}

TEST(ClosedForm, TakesItsValuesAtTheEndsWhereItIsMonotone) {
  Parabola kernel(0);
  kernel.with_determinant_derivatives(slope_of_parabola);
  const Interval det = bounds(kernel, {{3, 5}});
  EXPECT_TRUE(certain_subset(Interval(3, 15), det));
  EXPECT_LT(det.hi - 15, 1e-12);
  EXPECT_LT(3 - det.lo, 1e-12);
  const Interval falling = bounds(kernel, {{-5, -3}});
  EXPECT_TRUE(certain_subset(Interval(15, 35), falling));
  EXPECT_LT(falling.hi - 35 + 15 - falling.lo, 1e-12);
}

/// det = xy − z³ + xz: the box decides whether it rises, falls or does neither.
TEST(ClosedForm, EnclosesTheDeterminantOnRandomBoxes) {
  const auto value = [](const Values& x) {
    return Values{x[0] * x[1] - x[2] * x[2] * x[2] + x[2] * x[0]};
  };
  FunctionKernel kernel(3, 1, 1, value);
  kernel.with_determinant(value).with_determinant_derivatives([](const Values& x) {
    return Values{x[1] + x[2], x[0], x[0] - 3.0 * sqr(x[2])};
  });
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> middle(-2, 2), part(0, 1);
  for (int repetition = 0; repetition < 500; ++repetition) {
    std::vector<Interval> box;
    for (int k = 0; k < 3; ++k) {
      const double at = middle(random), radius = part(random) * part(random);
      box.emplace_back(at - radius, at + radius);
    }
    const Interval det = bounds(kernel, box);
    for (int sample = 0; sample < 40; ++sample) {
      Values x;
      for (const Interval& range : box) {
        const auto corner = random() % 4;
        x.emplace_back(corner == 0   ? range.lo
                       : corner == 1 ? range.hi
                                     : range.lo + part(random) * (range.hi - range.lo));
        x.back() = *intersect(x.back(), range);
      }
      const Interval exact = value(x)[0];
      EXPECT_LE(det.lo, exact.hi);
      EXPECT_GE(det.hi, exact.lo);
    }
    EXPECT_TRUE(certain_subset(det, value(box)[0])) << "never wider than the natural enclosure";
  }
}

TEST(ClosedForm, DecidesAParabolaInFewerBoxesWithDerivatives) {
  Parabola plain(1.001), with_slope(1.001);
  with_slope.with_determinant_derivatives(slope_of_parabola);
  const Result natural = solve(problem_over(plain, {{-4, 5}}), closed_form());
  const Result monotone = solve(problem_over(with_slope, {{-4, 5}}), closed_form());
  EXPECT_EQ(natural.verdict, Verdict::kNoSingularity);
  EXPECT_EQ(monotone.verdict, Verdict::kNoSingularity);
  EXPECT_LT(4 * monotone.statistics.boxes, natural.statistics.boxes);
  EXPECT_GT(monotone.statistics.leaves[kClosedFormLeaves], 0u);
}

TEST(ClosedForm, ComparesWithTheThresholdAfterTheRowScales) {
  // |det J⁻¹| = 2·3 = 6 at x = 3 and 2·1.5 = 3 at x = 1.5.
  const auto value = [](const Values& x) { return Values{x[0]}; };
  FunctionKernel kernel(1, 1, 1, value);
  kernel.with_determinant(value).with_row_scale([](const Values&) { return Values{2.0}; });
  const auto verdict = [&](double alpha) {
    return solve(problem_over(kernel, {{1.5, 3}}, Interval(alpha)), closed_form()).verdict;
  };
  EXPECT_EQ(verdict(2.9), Verdict::kNoSingularity);
  EXPECT_EQ(verdict(3.1), Verdict::kSingularity);
}

TEST(ClosedForm, AnUndefinedDeterminantIsNeverSafe) {
  const auto value = [](const Values& x) { return Values{sqrt(x[0]) + 1.0}; };
  FunctionKernel kernel(1, 1, 1, value);
  kernel.with_determinant(value).with_determinant_derivatives(
      [](const Values& x) { return Values{0.5 / sqrt(x[0])}; });
  EXPECT_EQ(solve(problem_over(kernel, {{0, 1}}), closed_form()).verdict, Verdict::kNoSingularity);
  EXPECT_EQ(solve(problem_over(kernel, {{-0.25, 1}}), closed_form()).verdict,
            Verdict::kPossibleProblem);
}

TEST(ClosedForm, UndefinedDerivativesDecideNothing) {
  // |x| − 1 has no derivative at 0.
  const auto value = [](const Values& x) { return Values{abs(x[0]) - 1.0}; };
  FunctionKernel kernel(1, 1, 1, value);
  kernel.with_determinant(value).with_determinant_derivatives(
      [](const Values& x) { return Values{x[0] / abs(x[0])}; });
  EXPECT_TRUE(certain_subset(Interval(-1, 1), bounds(kernel, {{-2, 2}})));
}

}  // namespace
}  // namespace regulus::detail::test
