// SPDX-License-Identifier: GPL-3.0-or-later
// The derivatives of the equations of a whole arm against differences.
#include "codegen/question/solve/arm_system.hpp"

#include <gtest/gtest.h>

#include <random>

#include "codegen/model/file/model_file.hpp"
#include "runtime/interval/floating_point_scope.hpp"

namespace regulus::detail {
namespace {

constexpr std::size_t n = kJoints;

/// Six joints about skew axes; `kind` of the third.
Model arm(const std::string& kind) {
  return parse_model(
      "regulus = 1\nname = \"arm\"\n[serial]\nunit = \"m\"\njoints = [\n{ name = \"a\", xyz = [0, "
      "0, "
      "0.4] },\n{ name = \"b\", xyz = [0.1, 0.2, 0], axis = [0, 3, 4] },\n{ name = \"c\", xyz = "
      "[0.5, 0, "
      "0.1], axis = [0, 1, 0]" +
          kind +
          " },\n{ name = \"d\", xyz = [0, 0.1, 0.3], axis = [1, 0, 0] },\n{ name = \"e\", xyz = "
          "[0.4, 0, "
          "0], axis = [0, 1, 0] },\n{ name = \"f\", xyz = [0, 0.05, 0], axis = [3, 0, 4] },\n]\n"
          "[motion.m]\na = 0.1\nb = 0.2\nc = 0.3\nd = 0.4\ne = 0.5\nf = 0.6\n",
      "arm");
}

RootSystem::Values at(WholeArm& system, const std::vector<double>& q) {
  std::vector<Interval> box(q.begin(), q.end());
  system.evaluate({&box, 1}, true);
  return system.at(0).value();
}

TEST(WholeArm, HasTheSecondDerivativesOfItsEquations) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-3, 3);
  for (const char* kind : {"", ", type = \"prismatic\""}) {
    const Model model = arm(kind);
    const ArmChain chain = enclose_chain(model, ArmGeometry::kNominal);
    const LinkFrame target = posture_at(chain, std::vector<Interval>(n, Interval(0.3))).end;
    WholeArm system(chain, target, true);
    for (int trial = 0; trial < 5; ++trial) {
      std::vector<double> q(n);
      for (double& x : q) x = angle(random);
      const RootSystem::Values here = at(system, q);
      ASSERT_EQ(here.rates_by_unknown.size(), n * n * n);
      for (std::size_t by = 0; by < n; ++by) {
        constexpr double h = 1e-6;
        std::vector<double> up = q, down = q;
        up[by] += h, down[by] -= h;
        const RootSystem::Values above = at(system, up), below = at(system, down);
        for (std::size_t e = 0; e < n * n; ++e)
          EXPECT_NEAR(mid(here.rates_by_unknown[by * n * n + e]),
                      (mid(above.by_unknown[e]) - mid(below.by_unknown[e])) / (2 * h), 1e-7)
              << kind << " joint " << by << ", entry " << e;
      }
    }
  }
}

}  // namespace
}  // namespace regulus::detail
