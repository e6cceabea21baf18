// SPDX-License-Identifier: GPL-3.0-or-later
// What follows a configuration must not come to another one by chance.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "runtime/interval/floating_point_scope.hpp"
#include "tests/property/closure/checked_closures.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;

/// A crank of length 0.5 with a rod of length 1, which never turns.
std::string crank_slider(const std::string& range) {
  return "regulus = 1\nname = \"z\"\n[pose]\nth = \"rad\"\n[closure]\n"
         "unknowns = { s = \"m\", p = \"rad\" }\n"
         "equations = [\"0.5*cos(th) + cos(p) - s\", \"0.5*sin(th) + sin(p)\"]\n"
         "start = { th = 0, s = 1.5, p = 0 }\n[motion.m]\nth = " +
         range + "\n";
}

std::optional<BranchPoint> tracked(const std::string& text, double to) {
  ModelOptions options;
  options.motion = "m";
  const PreparedClosure prepared =
      prepare_closure(read_request(text, options), 0, usual_options(), {});
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  SystemBoxes system(prepared.problem, prepared.scaling, prepared.shape);
  const std::vector<double> place{to};
  const auto found = track(system, prepared.shape, prepared.near_start, {&place, 1});
  return found[0] ? std::optional(found[0]->at) : std::nullopt;
}

TEST(ATrackedConfiguration, DoesNotTurnWithItsCrankByChance) {
  const std::string text = crank_slider("[0, 150]");
  for (int k = 1; k < 600; ++k) {
    const double theta = k * std::numbers::pi / 16;
    const auto found = tracked(text, theta);
    ASSERT_TRUE(found) << theta;
    EXPECT_NEAR(found->unknowns[1], -std::asin(0.5 * std::sin(theta)), 1e-9) << theta;
  }
}

TEST(ATrackedConfiguration, LeadsOverManyTurns) {
  const CheckedClosure checked = check_closure_text(crank_slider("[0, 26]"), usual_options());
  EXPECT_EQ(checked.verdict(), Verdict::kNoSingularity) << reason_of(checked.found);
}

TEST(ATrackedConfiguration, LeadsOverAPartOfAMotionThatItLeadsOver) {
  const auto verdict_over = [](const std::string& range) {
    return check_closure_text(
               "regulus = 1\nname = \"r3\"\n[pose]\nth = \"rad\"\n[closure]\n"
               "unknowns = { t = \"rad\" }\nequations = [\"-0.2677 - 0.3271*cos(th) - "
               "0.6026*cos(t) - 0.1603*cos(th)*cos(t) + 0.4423*sin(th)*sin(t)\"]\n"
               "start = { th = 0.5, t = 2.0935 }\nradius = { t = 0.1 }\n[motion.m]\nth = " +
                   range + "\n",
               usual_options())
        .verdict();
  };
  for (const char* range :
       {"[-3, 3]", "[-3, 1]", "[-3, 0.9]", "[-3, 0.8]", "[-3, 0.7]", "[-2.5, 0.9]"})
    EXPECT_EQ(verdict_over(range), Verdict::kNoSingularity) << range;
}

TEST(APavingOfABranch, FindsItsEnd) {
  const std::string text =
      "regulus = 1\nname = \"f\"\n[pose]\nth = \"rad\"\n[closure]\n"
      "unknowns = { ph = \"rad\", ps = \"rad\" }\nequations = "
      "[\"0.75*cos(th)+1.66*cos(ph)-0.47-1.3*cos(ps)\",\"0.75*sin(th)+1.66*sin(ph)-1.3*sin(ps)\"]\n"
      "start = { th = -1.1, ph = 2.206816542, ps = -3.680365712 }\n"
      "radius = { ph = 1e-6, ps = 1e-6 }\n[motion.m]\nth = [-1.2, 4.9]\n";
  ModelOptions options;
  options.motion = "m";
  PreparedClosure prepared = prepare_closure(read_request(text, options), 0, usual_options(), {});
  const ClosureFinding found = pave_closure(prepared, usual_options(), 0x1p-9, {}, {});
  ASSERT_EQ(found.folds.size(), 1U);
  EXPECT_TRUE(found.folds[0].is_on_branch);
  const double square = 0.36 * 0.36;  // of the distance where rod and follower are in line
  EXPECT_NEAR(mid(found.folds[0].place[0]),
              -std::acos((0.75 * 0.75 + 0.47 * 0.47 - square) / (2 * 0.75 * 0.47)), 1e-9);
}

/// The unknown u is e/2, so its tubes are very thin.
TEST(AFoldOfTwoCircles, IsVerified) {
  const CheckedClosure checked = check_closure_text(
      "regulus = 1\nname = \"two circles\"\n[pose]\ne = \"m\"\n[closure]\n"
      "unknowns = { u = \"m\", v = \"m\" }\n"
      "equations = [\"u^2+v^2-0.25\", \"(u-e)^2+v^2-0.25\"]\n"
      "start = { e = 0.6, u = 0.3, v = 0.4 }\n[motion.m]\ne = [0.1, 1.1]\n",
      usual_options());
  EXPECT_EQ(checked.verdict(), Verdict::kSingularity);
  const verifier::Verification v = verified(certified_closure(checked));
  EXPECT_EQ(v.outcome, verifier::Outcome::kVerified) << describe(v);
}

/// A radius that is not given is made smaller, and the claim names it.
TEST(AStart, MayNeedASmallerRadiusThanTheUsualOne) {
  // Both solutions x ± 0.004 are within 0.01.
  const std::string model =
      "regulus = 1\nname = \"pair\"\n[pose]\nth = \"rad\"\n[closure]\n"
      "unknowns = { x = \"m\" }\n"
      "equations = [\"(x - th)^2 - 0.000016\"]\n"
      "start = { th = 0, x = 0.004 }\n";
  const std::string motion = "[motion.m]\nth = [-1, 1]\n";
  const CheckedClosure checked = check_closure_text(model + motion, usual_options());
  ASSERT_EQ(checked.verdict(), Verdict::kNoSingularity) << reason_of(checked.found);
  const std::string proof = certified_closure(checked);
  EXPECT_THAT(proof, HasSubstr("unknown x = 1/250 +- 1/1000\n"));
  const verifier::Verification v = verified(proof, model + motion);
  EXPECT_EQ(v.outcome, verifier::Outcome::kVerified) << describe(v);
  const std::string given = model + "radius = { x = 0.01 }\n" + motion;
  EXPECT_EQ(verified(proof, given).outcome, verifier::Outcome::kRejected);
  const CheckedClosure other = check_closure_text(given, usual_options());
  EXPECT_EQ(other.verdict(), Verdict::kPossibleProblem);
  EXPECT_THAT(reason_of(other.found), HasSubstr("exactly one configuration"));
}

TEST(AStart, ThatIsNoConfigurationIsNamed) {
  const std::string text =
      "regulus = 1\nname = \"far\"\n[pose]\nth = \"rad\"\n[closure]\n"
      "unknowns = { x = \"m\" }\nequations = [\"x^2 - 4 - th\"]\n"
      "start = { th = 0, x = 3 }\n[motion.m]\nth = [-1, 1]\n";
  const CheckedClosure checked = check_closure_text(text, usual_options());
  EXPECT_EQ(checked.verdict(), Verdict::kPossibleProblem);
  EXPECT_EQ(checked.found.searched.branch.boxes, 0U);
  EXPECT_THAT(reason_of(checked.found),
              HasSubstr("no configuration was found within the 'radius'"));
}

}  // namespace
}  // namespace regulus::detail::test
