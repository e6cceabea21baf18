// SPDX-License-Identifier: GPL-3.0-or-later
// Closures whose uncertain quantities are too large to be taken whole, against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/property/closure/checked_closures.hpp"

namespace regulus::detail {
namespace {

using test::certified_closure;
using test::CheckedClosure;

/// p = √(1 + x + a·u + b·v) with |x| ≤ 1/100: regular exactly where the root is of a positive number.
std::string root(double a, double b, const std::string& of_uncertain) {
  return fmt::format(
      "regulus = 1\nname = \"root\"\n[pose]\nx = \"m\"\n[geometry]\n{}\n[closure]\n"
      "unknowns = {{ p = \"m\" }}\nequations = [\"p^2 - 1 - x + ({})*e_1 + ({})*e_2\"]\n"
      "start = {{ x = 0, p = 1 }}\n[motion.m]\nx = [-0.01, 0.01]\n",
      of_uncertain, a, b);
}

CheckedClosure check_for_a_while(const std::string& text) {
  SearchOptions search = test::usual_options();
  search.max_boxes = 300;
  return test::check_closure_text(text, search);
}

/// The most that the uncertain quantities take away, and the verdict that follows.
void expect_verdict(const std::string& text, double most, int& proved, int& refuted) {
  const CheckedClosure checked = check_for_a_while(text);
  if (checked.verdict() == Verdict::kNoSingularity) {
    ++proved;
    EXPECT_LT(most, 0.99) << text;
    const verifier::Verification v = test::verified(certified_closure(checked), text);
    EXPECT_EQ(v.outcome, verifier::Outcome::kVerified) << describe(v);
  }
  if (checked.verdict() != Verdict::kSingularity) return;
  ++refuted;
  EXPECT_GE(most, 0.99) << text;
  const Fold& fold = checked.found.folds.front();
  ASSERT_EQ(fold.place.size(), 3U);
  EXPECT_LE(mag(fold.place[0]), 0.01);
}

TEST(UncertainQuantities, AreHalvedWhereTheMotionAloneDoesNotHelp) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> factor(-1, 1);
  int proved = 0, refuted = 0;
  for (int count = 0; count < 40; ++count) {
    const double a = factor(random), b = factor(random);
    const double most = 0.75 * (std::fabs(a) + std::fabs(b));
    if (std::fabs(most - 0.99) < 0.03) continue;
    expect_verdict(root(a, b, "e = { value = [0, 0], tolerance = 0.75, group = \"g\" }"), most,
                   proved, refuted);
  }
  EXPECT_GE(proved, 15);
  EXPECT_GE(refuted, 5);
}

/// A corner of the box around a ball is none of its points.
TEST(UncertainQuantities, OfABallAreTakenWithinIt) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> factor(-1.2, 1.2);
  int proved = 0, refuted = 0;
  for (int count = 0; count < 20; ++count) {
    const double a = factor(random), b = factor(random);
    const double most = 0.9 * std::hypot(a, b);
    if (std::fabs(most - 0.99) < 1e-3) continue;
    expect_verdict(root(a, b, "e = { value = [0, 0], radius = 0.9, group = \"g\" }"), most, proved,
                   refuted);
  }
  EXPECT_GE(proved, 3);
  EXPECT_GE(refuted, 3);
}

/// p = √(1 + x + Σ aₖ eₖ): the branch ends in one corner of nine ranges alone.
TEST(UncertainQuantities, ThatEndTheBranchInOneCornerOfManyAreFound) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> factor(0.5, 1), part(0.93, 1.07);
  int refuted = 0;
  for (int count = 0; count < 16; ++count) {
    std::string text =
        "regulus = 1\nname = \"root\"\n[pose]\nx = \"m\"\n[geometry]\n"
        "e = { value = [0, 0, 0, 0, 0, 0, 0, 0], tolerance = 0.125, group = \"g\" }\n[closure]\n"
        "unknowns = { p = \"m\" }\nequations = [\"p^2 - 1 - x";
    double sum = 0;
    std::vector<double> factors(8);
    for (double& a : factors) sum += a = factor(random);
    const double most = 0.99 * part(random);
    for (std::size_t k = 0; k < 8; ++k)
      text += fmt::format(" + ({})*e_{}", (k % 3 == 0 ? -8 : 8) * most * factors[k] / sum, k + 1);
    text += "\"]\nstart = { x = 0, p = 1 }\n[motion.m]\nx = [-0.01, 0.01]\n";
    if (std::fabs(most - 0.99) < 0.01) continue;
    SearchOptions search = test::usual_options();
    search.max_boxes = 2000;
    const CheckedClosure checked = test::check_closure_text(text, search);
    refuted += checked.verdict() == Verdict::kSingularity ? 1 : 0;
    EXPECT_NE(checked.verdict(), most < 0.99 ? Verdict::kSingularity : Verdict::kNoSingularity);
    if (most < 0.99) continue;
    ASSERT_EQ(checked.verdict(), Verdict::kSingularity) << text;
    const verifier::Verification v = test::verified(certified_closure(checked), text);
    EXPECT_EQ(v.outcome, verifier::Outcome::kVerified) << describe(v);
  }
  EXPECT_GE(refuted, 5);
}

/// The ranges of the legs as errors of one pose: the same boxes as of a motion through them.
TEST(UncertainQuantities, AreHalvedAsRangesOfAMotionAre) {
  const std::string legs[2] = {
      "l1 = [\"sqrt(50) - 0.2\", \"sqrt(50) + 0.2\"]\nl2 = [\"sqrt(26) - 0.2\", \"sqrt(26) + "
      "0.2\"]\nl3 = [4.8, 5.2]\n",
      "l1 = \"sqrt(50)\"\nl2 = \"sqrt(26)\"\nl3 = 5\nerror = { l1 = 0.2, l2 = 0.2, l3 = 0.2 }\n"};
  std::uint64_t boxes[2] = {0, 0};
  for (const int i : {0, 1}) {
    const std::string text = test::rpr(legs[i]);
    const CheckedClosure checked = test::check_closure_text(text, test::usual_options());
    EXPECT_EQ(checked.verdict(), Verdict::kNoSingularity);
    boxes[i] = checked.found.searched.branch.boxes;
    const verifier::Verification v = test::verified(certified_closure(checked), text);
    EXPECT_EQ(v.outcome, verifier::Outcome::kVerified) << describe(v);
    EXPECT_GT(v.links, 50U);
  }
  EXPECT_EQ(boxes[0], boxes[1]);
}

}  // namespace
}  // namespace regulus::detail
