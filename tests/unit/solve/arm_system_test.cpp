// SPDX-License-Identifier: GPL-3.0-or-later
// The derivatives of the equations of an arm against differences.
#include "codegen/question/solve/arm_system.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "codegen/model/file/model_file.hpp"
#include "codegen/question/solve/coupled_axes.hpp"
#include "runtime/interval/floating_point_scope.hpp"

namespace regulus::detail {
namespace {

constexpr std::size_t n = kJoints;

/// Six joints about skew axes; `kind` of the third, `more` behind the fourth.
Model arm(const std::string& kind, const std::string& more = "") {
  return parse_model(
      "regulus = 1\nname = \"arm\"\n[serial]\nunit = \"m\"\njoints = [\n{ name = \"a\", xyz = [0, "
      "0, "
      "0.4] },\n{ name = \"b\", xyz = [0.1, 0.2, 0], axis = [0, 3, 4] },\n{ name = \"c\", xyz = "
      "[0.5, 0, "
      "0.1], axis = [0, 1, 0]" +
          kind + " },\n{ name = \"d\", xyz = [0, 0.1, 0.3], axis = [1, 0, 0] },\n" + more +
          "{ name = \"e\", xyz = "
          "[0.4, 0, "
          "0], axis = [0, 1, 0] },\n{ name = \"f\", xyz = [0, 0.05, 0], axis = [3, 0, 4] },\n]\n"
          "[motion.m]\na = 0.1\nb = 0.2\nc = 0.3\nd = 0.4\ne = 0.5\nf = 0.6\n",
      "arm");
}

RootSystem::Values at(RootSystem& system, const std::vector<double>& q) {
  std::vector<Interval> box(q.begin(), q.end());
  system.evaluate({&box, 1}, true);
  return system.at(0).value();
}

std::vector<double> moved(std::vector<double> q, std::size_t by, double step) {
  q[by] += step;
  return q;
}

void expect_derivatives(RootSystem& system, const std::vector<double>& q) {
  constexpr double h = 1e-6;
  const std::size_t m = q.size();
  const RootSystem::Values here = at(system, q);
  ASSERT_EQ(here.rates_by_unknown.size(), m * m * m);
  for (std::size_t by = 0; by < m; ++by) {
    const RootSystem::Values above = at(system, moved(q, by, h)),
                             below = at(system, moved(q, by, -h));
    for (std::size_t e = 0; e < m; ++e)
      EXPECT_NEAR(mid(here.by_unknown[e * m + by]),
                  (mid(above.value[e]) - mid(below.value[e])) / (2 * h), 1e-7);
    for (std::size_t e = 0; e < m * m; ++e)
      EXPECT_NEAR(mid(here.rates_by_unknown[by * m * m + e]),
                  (mid(above.by_unknown[e]) - mid(below.by_unknown[e])) / (2 * h), 1e-6)
          << "unknown " << by << ", entry " << e;
  }
}

std::vector<double> random_place(std::mt19937& random, std::size_t count) {
  std::uniform_real_distribution<double> value(-3, 3);
  std::vector<double> q(count);
  for (double& x : q) x = value(random);
  return q;
}

/// Followers of joints before and behind them, one of which slides.
constexpr const char* kFollowers =
    "{ mimic = \"b\", multiplier = -1, offset = 0.2, xyz = [0.1, 0, 0.3], axis = [0, 3, 4] },\n"
    "{ mimic = \"f\", multiplier = 0.7, xyz = [0.1, 0.2, 0], axis = [1, 0, 0] },\n"
    "{ mimic = \"b\", type = \"prismatic\", multiplier = 0.3, axis = [0, 1, 0] },\n";

TEST(WholeArm, HasTheDerivativesOfItsEquations) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  std::mt19937 random(1);
  for (const char* more : {"", kFollowers})
    for (const char* kind : {"", ", type = \"prismatic\""}) {
      const ArmChain chain = enclose_chain(arm(kind, more), ArmGeometry::kNominal);
      const LinkFrame target = posture_at(chain, std::vector<Interval>(n, Interval(0.3))).end;
      WholeArm system(chain, target, true);
      for (int trial = 0; trial < 5; ++trial) expect_derivatives(system, random_place(random, n));
    }
}

/// The values are 0 at a posture, and only there if the other two are right.
TEST(CoupledAxes, HaveTheDerivativesOfTheirEquations) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  std::mt19937 random(2);
  // Joints a, c, d and e have no followers; they are 0, 2, 3 and 7 of the chain.
  const std::vector<CoupledChoice> choices = {
      {0, 2, {1, 3, 4, 5}}, {0, 7, {1, 2, 3, 5}}, {3, 7, {0, 1, 2, 5}}, {2, 3, {0, 1, 4, 5}}};
  for (const char* kind : {"", ", type = \"prismatic\""})
    for (CoupledChoice choice : choices) {
      const ArmChain chain = enclose_chain(arm(kind, kFollowers), ArmGeometry::kNominal);
      if (!chain[choice.b].turns) std::swap(choice.a, choice.b);
      const std::vector<double> posture = random_place(random, n);
      const LinkFrame target =
          posture_at(chain, std::vector<Interval>(posture.begin(), posture.end())).end;
      CoupledAxes system(std::make_shared<TrigForms>(coupled_equations(chain, target, choice)),
                         CoupledAxes::rows_of(kFour, chain[choice.a].turns));
      expect_derivatives(system, random_place(random, kFour));
      std::vector<double> four;
      for (const std::size_t k : choice.searched) four.push_back(posture[k]);
      const std::vector<Interval> points(four.begin(), four.end());
      const RootSystem::Values there = at(system, four);
      for (const Interval& value : there.value) EXPECT_TRUE(contains_zero(value));
      EXPECT_TRUE(contains_zero(there.also.front()));
      const auto others = approx_values(pair_in_loop(chain, target, choice, points));
      for (const auto& [joint, value] :
           {std::pair{choice.a, others[0]}, std::pair{choice.b, others[1]}}) {
        const double gap = value - posture[chain[joint].unknown];
        EXPECT_NEAR(chain[joint].turns ? std::remainder(gap, 2 * mid(kPi)) : gap, 0, 1e-9);
      }
    }
}

}  // namespace
}  // namespace regulus::detail
