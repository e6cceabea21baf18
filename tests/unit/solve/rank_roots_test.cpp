// SPDX-License-Identifier: GPL-3.0-or-later
// What another process is told by a number: it judges boxes as this one does.
#include "codegen/question/solve/rank_roots.hpp"

#include <gtest/gtest.h>

#include <random>

#include "codegen/model/request.hpp"
#include "codegen/question/solve/arm_place.hpp"
#include "codegen/question/solve/platform_legs.hpp"
#include "codegen/question/solve/pose_search.hpp"
#include "codegen/question/solve/solve_run.hpp"
#include "runtime/interval/floating_point_scope.hpp"

namespace regulus::detail {
namespace {

Request request_of(const std::string& model, const std::vector<std::string>& at,
                   const std::vector<std::string>& tolerances = {}) {
  ModelOptions options;
  options.tolerances = tolerances;
  options.path = REGULUS_SOURCE_DIR "/models/" + model + ".toml";
  options.at = at;
  return read_solve_request(options, {});
}

Request platform() {
  return request_of("robot_1", {"x=1", "y=2", "z=47", "psi=0.1", "theta=0.12", "phi=0.05"});
}
Request puma(const std::vector<std::string>& tolerances = {}) {
  return request_of("puma_560_serial",
                    {"q1=0.3", "q2=0.4", "q3=-0.7", "q4=0.3", "q5=0.9", "q6=-1.4"}, tolerances);
}

/// Both leave the same of random boxes, and not all of each.
void expect_same(const RootSystems& told, const RootSystems& own) {
  ASSERT_EQ(told.unknowns, own.unknowns);
  EXPECT_EQ(told.number, own.number);
  Problem problem;
  problem.outer.resize(own.unknowns);
  RootJudge there(told.question(problem)), here(own.question(problem));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> middle(-1, 1);
  bool is_narrowed = false;
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<RootJudge::Box> boxes(1);
    for (std::size_t k = 0; k < own.unknowns; ++k) {
      const double x = middle(random);
      boxes[0].emplace_back(x - 0.1, x + 0.1);
    }
    std::vector<RootFinding> one(1), other(1);
    there.judge(boxes, one, 0);
    here.judge(boxes, other, 0);
    EXPECT_EQ(one[0].is_empty, other[0].is_empty);
    EXPECT_EQ(one[0].is_regular, other[0].is_regular);
    EXPECT_EQ(one[0].unknowns, other[0].unknowns);
    EXPECT_EQ(one[0].impact, other[0].impact);
    is_narrowed = is_narrowed || one[0].is_empty || one[0].unknowns != boxes[0];
  }
  EXPECT_TRUE(is_narrowed);
}

TEST(RootsOfRanks, AreThoseOfTheArm) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  const Request request = puma();
  const ArmAtPlace place = arm_at_place(request, {});
  for (const std::size_t number : {std::size_t{0}, std::size_t{1}, std::size_t{2}, kWholeArm})
    expect_same(systems_of(request, {}, number), systems_of_arm(place, number));
  for (const std::size_t number : {kOppositePairs, kWholeArm - 1, kWholeArm + 1})
    EXPECT_EQ(systems_of(request, {}, number).unknowns, 0U);
}

/// Of an arm within tolerances: at once, of the nominal arm, and where its postures are followed.
TEST(RootsOfRanks, AreThoseOfAnArmThatIsFollowed) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  const Request request = puma({"links=0.003"});
  const ArmAtPlace within = arm_at_place(request, {}), nominal = nominal_arm_at_place(request, {});
  for (const std::size_t number : {std::size_t{0}, std::size_t{2}, kWholeArm}) {
    expect_same(systems_of(request, {}, number), systems_of_arm(within, number));
    RootSystems of_nominal = systems_of_arm(nominal, number);
    of_nominal.number += kNominalArm;
    expect_same(systems_of(request, {}, number + kNominalArm), of_nominal);
    expect_same(systems_of(request, {}, number + kFollowedArm),
                followed_systems_of_arm(within, number));
  }
  EXPECT_EQ(systems_of(request, {}, kOppositePairs + kFollowedArm).unknowns, 0U);
}

TEST(RootsOfRanks, AreThoseOfThePlatform) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  const Request request = platform();
  const GoughLegs legs = enclose_legs(request);
  const auto one = std::make_shared<const PoseEquations>(legs);
  const auto all = std::make_shared<const FollowedEquations>(legs, enclose_uncertain_legs(request));
  for (int chart = 0; chart < kChartsOfRotations; ++chart) {
    expect_same(systems_of(request, {}, std::size_t(chart)), systems_of_chart(one, chart));
    expect_same(systems_of(request, {}, std::size_t(chart + kChartsOfRotations)),
                systems_of_chart(all, chart));
  }
  EXPECT_EQ(systems_of(request, {}, 2 * kChartsOfRotations).unknowns, 0U);
}

TEST(RootsOfRanks, HaveAKernelIfTheyAreEquations) {
  EXPECT_TRUE(kernel_request(request_of("rpr_6", {})));
  EXPECT_TRUE(kernel_request(request_of("double_butterfly", {"theta=67.38"})));
  EXPECT_FALSE(kernel_request(platform()));
  EXPECT_FALSE(kernel_request(puma()));
}

}  // namespace
}  // namespace regulus::detail
