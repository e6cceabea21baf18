// SPDX-License-Identifier: GPL-3.0-or-later
// Ranges of unknowns, against the closed form: sin p = ½ sin θ over a turn, so that p is in [−π/6, π/6].
#include <gtest/gtest.h>

#include <cmath>

#include "tests/property/closure/checked_closures.hpp"
#include "tests/support/random_source.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test::unknown_range_test {
namespace {

std::string sine(const std::string& lower, const std::string& upper) {
  return "regulus = 1\nname = \"sine\"\n[pose]\nth = \"rad\"\n[closure]\nunknowns = { p = \"rad\" "
         "}\n"
         "equations = [\"sin(p) - 0.5*sin(th)\"]\nstart = { th = 0, p = 0 }\n"
         "range = { p = [\"" +
         lower + "\", \"" + upper + "\"] }\n[motion.m]\nth = [\"-pi\", \"pi\"]\n";
}

CheckedClosure checked(const std::string& text) {
  SearchOptions search = usual_options();
  search.max_boxes = 1000;
  return check_closure_text(text, search);
}

TEST(ABranchWithinARange, IsProvedWhereTheRangeHoldsIt) {
  const double most = std::acos(-1) / 6;
  RandomSource random(61);
  int proved = 0;
  for (int round = 0; round < trials(16, 200); ++round) {
    const double lower = -most * std::pow(2, random.between(-1, 1)),
                 upper = most * std::pow(2, random.between(-1, 1));
    const std::string text = sine(std::to_string(lower), std::to_string(upper));
    const CheckedClosure found = checked(text);
    if (found.verdict() != Verdict::kNoSingularity) continue;
    ++proved;
    EXPECT_LT(lower, -most + 1e-6);
    EXPECT_GT(upper, most - 1e-6);
    const std::string certificate = certified_closure(found);
    EXPECT_EQ(verified(certificate, text).outcome, verifier::Outcome::kVerified);
  }
  EXPECT_GE(proved, 2);
}

/// Doubles enclose both ends alike.
TEST(ABranchWithinARange, IsNotProvedWhereRoundingIsWiderThanTheRange) {
  for (const auto& [lower, upper] :
       {std::pair("-1e-400", "1e-400"), {"-1e-330", "0"}, {"0", "1e-330"}, {"-pi/6", "1e-500"}})
    EXPECT_NE(checked(sine(lower, upper)).verdict(), Verdict::kNoSingularity) << lower;
  // The unknown is 1/3 at all poses, and both ends are between the same doubles.
  std::string third = sine("1/3 - 1e-30", "1/3 + 1e-30");
  for (const auto& [from, to] :
       {std::pair("sin(p) - 0.5*sin(th)", "3*p - 1"), {"p = 0", "p = \"1/3\""}})
    third.replace(third.find(from), std::string(from).size(), to);
  EXPECT_NE(checked(third).verdict(), Verdict::kNoSingularity);
}

}  // namespace
}  // namespace regulus::detail::test::unknown_range_test
