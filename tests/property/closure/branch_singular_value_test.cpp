// SPDX-License-Identifier: GPL-3.0-or-later
// Condition numbers in the 2-norm and singular values over a branch, against configurations in closed form
// or by Newton's method, and singular values of a library of their own.
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "tests/property/closure/four_bars.hpp"
#include "tests/property/closure/known_singular_values.hpp"

namespace regulus::detail::test::singular_values_over_a_branch {
namespace {

/// Keeps the extreme values of samples.
struct Seen {
  double condition = 0, largest = 0, least = kInfinity;
  void add(const Values& v) {
    condition = std::max(condition, v.condition);
    largest = std::max(largest, v.largest);
    least = std::min(least, v.least);
  }
};

/// `near`: how near the samples come to the largest value.
void expect_bracket(const ComponentBound& c, double seen, double gap, bool is_least, double near) {
  ASSERT_TRUE(c.proved && c.attained) << c.reason;
  EXPECT_TRUE(c.is_closed) << c.reason;
  const double sign = is_least ? -1 : 1;
  const double proved = sign * c.proved->approx, attained = sign * c.attained->approx;
  seen *= sign;
  EXPECT_LE(seen, proved + 1e-9 * std::fabs(proved));
  EXPECT_LE(proved - attained, gap * std::max(std::fabs(proved), std::fabs(attained)) * (1 + 1e-9));
  EXPECT_GE(seen, attained - near * std::fabs(attained));
}

void expect_brackets(const std::string& model, const Seen& seen, double near,
                     const Asked& asked = {}) {
  SCOPED_TRACE(model);
  expect_bracket(bound(model, kCondition, asked), seen.condition, asked.gap, false, near);
  expect_bracket(bound(model, kLargest, asked), seen.largest, asked.gap, false, near);
  expect_bracket(bound(model, kLeast, asked), seen.least, asked.gap, true, near);
}

Matrix matrix_at(const FourBar& f, double theta) {
  const FourBar::Angles at = f.at(theta);
  Matrix A(2, 2);
  A << -f.b * std::sin(at.phi), f.c * std::sin(at.psi), f.b * std::cos(at.phi),
      -f.c * std::cos(at.psi);
  return A;
}

/// Calls `test` for linkages with a motion that stays away from toggles.
template <class Test>
void for_linkages(unsigned seed, int wanted, const Test& test) {
  std::mt19937 random(seed);
  for (int tries = 0; wanted > 0 && tries < 400; ++tries) {
    const FourBar linkage = random_four_bar(random);
    std::uniform_real_distribution<double> angle(-3, 3), reach(0.05, 0.6);
    const double start = angle(random), from = start - reach(random), to = start + reach(random);
    bool is_regular = true;
    for (int i = 0; i <= 40; ++i)
      is_regular = is_regular && linkage.is_between_toggles(from + (to - from) * i / 40, 0.08);
    if (!is_regular) continue;
    --wanted;
    test(linkage, start, from, to, random);
  }
  EXPECT_EQ(wanted, 0);
}

TEST(SingularValuesOverABranch, HoldThoseOfEveryConfiguration) {
  for_linkages(3, 6, [](const FourBar& f, double start, double from, double to, std::mt19937&) {
    Seen seen;
    for (int i = 0; i <= 2000; ++i) seen.add(Values(matrix_at(f, from + (to - from) * i / 2000)));
    for (const double gap : {0.02, 1e-4})
      expect_brackets(f.text(start, from, to), seen, 1e-4 + gap, {.gap = gap});
  });
}

TEST(SingularValuesOverABranch, HoldThoseOfAllLinksWithinTheirTolerances) {
  constexpr double kTolerance = 1e-3;
  for_linkages(
      7, 3, [](const FourBar& f, double start, double from, double to, std::mt19937& random) {
        Seen seen;
        for (int i = 0; i <= 4000; ++i) {
          FourBar other = f;
          const auto spread = [&] {
            const unsigned where = random() % 3;
            return where < 2
                       ? (where == 0 ? -kTolerance : kTolerance)
                       : std::uniform_real_distribution<double>(-kTolerance, kTolerance)(random);
          };
          other.a += spread(), other.b += spread();
          seen.add(Values(matrix_at(other, from + (to - from) * (i / 8) / 500)));
        }
        expect_brackets(f.text(start, from, to, kTolerance), seen, 0.03);
      });
}

/// With tolerances, and with control errors of both motors.
TEST(SingularValuesOverABranch, HoldThoseOfNewtonsMethod) {
  for (const bool has_errors : {false, true}) {
    const double tolerance = has_errors ? 2e-3 : 0, error = has_errors ? 5e-3 : 0;
    std::mt19937 random(11);
    Seen seen;
    const auto pick = [&](double lo, double hi) {
      const unsigned where = random() % 3;
      return where == 0   ? lo
             : where == 1 ? hi
                          : std::uniform_real_distribution<double>(lo, hi)(random);
    };
    for (int i = 0; i < 1000; ++i) {
      const FiveBar at(pick(1.7, 2.3) + pick(-error, error), pick(0.8, 1.3) + pick(-error, error),
                       0.4 + pick(-tolerance, tolerance));
      ASSERT_LT(at.equations().norm(), 1e-12);
      seen.add(Values(at.matrix()));
    }
    Asked asked;
    if (has_errors) asked.tubes = {"s,t=0.005"};
    expect_brackets(FiveBar::text(has_errors ? "0.002" : "0"), seen, 0.03, asked);
  }
}

TEST(SingularValuesOverABranch, AreOfAMatrixInOneUnit) {
  for (const char* length : {"0.5", "1", "4"}) {
    Seen seen;
    for (int i = -2000; i <= 2000; ++i) seen.add(of_slider(i * 1e-3, std::stod(length)));
    for (const double gap : {0.02, 1e-5})
      expect_brackets(slider("[-2, 2]", length), seen, 2e-5 + gap, {.gap = gap});
  }
}

TEST(SingularValuesOverABranch, AreComparedWithALimit) {
  const std::string model = slider("[-2, 2]", "4");
  for (const QuantityOptions& words : {kCondition, kLargest, kLeast}) {
    const ComponentBound c = bound(model, words, {.gap = 1e-4});
    ASSERT_TRUE(c.is_closed) << c.reason;
    const double beyond = words.quantity == "sigma-min" ? 0.999 : 1.001;
    const auto verdict = [&](double limit) {
      return bound(model, words, {.limit = std::to_string(limit)}).verdict;
    };
    EXPECT_EQ(verdict(c.proved->approx * beyond), LimitVerdict::kWithin);
    EXPECT_EQ(verdict(c.attained->approx / beyond), LimitVerdict::kExceeded);
  }
}

/// A is singular where the branch ends.
TEST(SingularValuesOverABranch, EndWithTheBranch) {
  const FourBar linkage{0.2, 0.35355, 0.25, 0.45};
  const std::string model = linkage.text(0, -2.4, 2.4);
  EXPECT_TRUE(bound(model, kCondition).is_unbounded);
  EXPECT_EQ(bound(model, kCondition, {.limit = "1000"}).verdict, LimitVerdict::kExceeded);
  const ComponentBound least = bound(model, kLeast), largest = bound(model, kLargest);
  ASSERT_TRUE(least.attained.has_value());
  EXPECT_EQ(least.attained->approx, 0);
  EXPECT_EQ(bound(model, kLeast, {.limit = "0.001"}).verdict, LimitVerdict::kExceeded);
  for (const ComponentBound& c : {least, largest}) {
    EXPECT_FALSE(c.is_unbounded);
    EXPECT_FALSE(c.proved.has_value());
  }
  EXPECT_EQ(bound(model, kLargest, {.limit = "0.001"}).verdict, LimitVerdict::kUndecided);
}

}  // namespace
}  // namespace regulus::detail::test::singular_values_over_a_branch
