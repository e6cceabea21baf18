// SPDX-License-Identifier: GPL-3.0-or-later
// The derivatives of the equations of an arm by what varies, against differences.
#include "codegen/question/solve/arm_tubes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "codegen/model/request.hpp"
#include "codegen/question/solve/solve_run.hpp"
#include "runtime/interval/floating_point_scope.hpp"

namespace regulus::detail {
namespace {

constexpr std::size_t kQuantities = 4;

/// A length, an angle of a link that is also the height of another one, a part of the tool, and a part behind a joint
/// that is held.
Request arm(const std::array<double, kQuantities>& g, bool is_linear) {
  ModelOptions options;
  options.text = fmt::format(
      "regulus = 1\nname = \"arm\"\n[geometry]\n"
      "u = {{ value = {:.17g}, tolerance = 0.1 }}\nv = {{ value = {:.17g}, tolerance = 0.1 }}\n"
      "w = {{ value = {:.17g}, tolerance = 0.1 }}\ns = {{ value = {:.17g}, tolerance = 0.1 }}\n"
      "[serial]\njoints = [\n{{ name = \"a\", xyz = [0, 0, \"v\"] }},\n"
      "{{ name = \"b\", xyz = [\"u\", 0.2, 0], axis = [0, 3, 4] }},\n"
      "{{ mimic = \"b\", multiplier = -1, offset = 0.3, xyz = [0.1, 0, \"2*u\"], axis = [0, 3, 4] "
      "}},\n"
      "{{ name = \"c\", xyz = [0.5, 0, 0.1], {} axis = [0, 1, 0] }},\n"
      "{{ name = \"h\", xyz = [0.1, \"s\", 0], axis = [1, 0, 0] }},\n"
      "{{ name = \"d\", xyz = [0, 0.1, 0.3], axis = [1, 0, 0], type = \"prismatic\" }},\n"
      "{{ name = \"e\", xyz = [0.4, 0, 0], axis = [0, 1, 0] }},\n"
      "{{ name = \"f\", xyz = [0, 0.05, 0], axis = [3, 0, 4] }},\n]\n"
      "tool = {{ xyz = [\"w\", 0, 0.1] {} }}\n"
      "[motion.there]\ntool = [0.3, 0.4, 0.5, 0.1, 0.2, 0.3]\n",
      g[0], g[1], g[2], g[3], is_linear ? "" : "rpy = [0, \"v\", 0],",
      is_linear ? "" : ", rpy = [\"w\", 0, 0]");
  options.at = {"x=0.3", "y=0.4", "z=0.5", "roll=0.1", "pitch=0.2", "yaw=0.3", "h=0.4"};
  return read_solve_request(options, {});
}

VaryingValues values_at(const std::array<double, kQuantities>& g, const std::vector<double>& q,
                        bool is_linear) {
  const Request request = arm(g, is_linear);
  const ArmAtPlace at = *arm_at_place(request, {}).nominal;
  EXPECT_EQ(at.chain.front().rates.size(), kQuantities);
  EXPECT_EQ(at.is_linear, is_linear);
  return varying_values(at, std::vector<Interval>(q.begin(), q.end()));
}

/// Entry e of the derivative by number `by` of entries with `count` columns is near the difference.
void expect_near(const std::vector<Interval>& derivative, const std::vector<Interval>& above,
                 const std::vector<Interval>& below, double h, const std::string& what) {
  ASSERT_EQ(derivative.size(), above.size());
  for (std::size_t e = 0; e < above.size(); ++e) {
    if (derivative[e] == kEntire) continue;
    EXPECT_NEAR(mid(derivative[e]), (mid(above[e]) - mid(below[e])) / (2 * h), 1e-6) << what << e;
  }
}

std::vector<Interval> part(const std::vector<Interval>& all, std::size_t from, std::size_t count) {
  const auto first = all.begin() + std::ptrdiff_t(from * count);
  return {first, first + std::ptrdiff_t(count)};
}
std::vector<Interval> column(const std::vector<Interval>& matrix, std::size_t columns,
                             std::size_t k) {
  std::vector<Interval> result;
  for (std::size_t row = 0; row < kJoints; ++row) result.push_back(matrix[row * columns + k]);
  return result;
}

TEST(AnArmThatVaries, HasTheDerivativesOfItsEquations) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  constexpr double h = 1e-5;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(0.1, 0.9), angle(-3, 3);
  for (const bool is_linear : {true, false})
    for (int trial = 0; trial < 2; ++trial) {
      std::array<double, kQuantities> g{};
      for (double& x : g) x = number(random);
      std::vector<double> q(kJoints);
      for (double& x : q) x = angle(random);
      const VaryingValues here = values_at(g, q, is_linear);
      ASSERT_EQ(here.rates_by_unknown.size(), (kQuantities + kJoints) * kJoints * kJoints);
      ASSERT_EQ(here.rates_by_variable.size(), (kQuantities + kJoints) * kJoints * kQuantities);
      for (std::size_t by = 0; by < kQuantities + kJoints; ++by) {
        auto g_up = g, g_down = g;
        auto q_up = q, q_down = q;
        (by < kQuantities ? g_up[by] : q_up[by - kQuantities]) += h;
        (by < kQuantities ? g_down[by] : q_down[by - kQuantities]) -= h;
        const VaryingValues up = values_at(g_up, q_up, is_linear),
                            down = values_at(g_down, q_down, is_linear);
        const std::string what = fmt::format("{} by {}, entry ", is_linear, by);
        expect_near(by < kQuantities ? column(here.by_variable, kQuantities, by)
                                     : column(here.by_unknown, kJoints, by - kQuantities),
                    up.value, down.value, h, "value " + what);
        expect_near(part(here.rates_by_unknown, by, kJoints * kJoints), up.by_unknown,
                    down.by_unknown, h, "by unknown " + what);
        expect_near(part(here.rates_by_variable, by, kJoints * kQuantities), up.by_variable,
                    down.by_variable, h, "by variable " + what);
      }
      const bool is_entire =
          std::ranges::find(here.rates_by_variable, kEntire) != here.rates_by_variable.end();
      EXPECT_NE(is_entire, is_linear);
    }
}

/// Six joints that turn, or of which the third slides, with tolerances of lengths, angles and the tool.
Request plain_arm(const std::string& kind) {
  ModelOptions options;
  options.text =
      "regulus = 1\nname = \"arm\"\n[geometry]\n"
      "u = { value = 0.5, tolerance = 0.01 }\nv = { value = 0.3, tolerance = 0.02 }\n"
      "w = { value = 0.2, tolerance = 0.01 }\n"
      "[serial]\njoints = [\n{ name = \"a\", xyz = [0, 0, \"v\"] },\n"
      "{ name = \"b\", xyz = [\"u\", 0.2, 0], rpy = [\"w\", 0, 0], axis = [0, 3, 4] },\n"
      "{ name = \"c\", xyz = [0.5, \"u*v\", 0.1], axis = [0, 1, 0]" +
      kind +
      " },\n{ name = \"d\", xyz = [0, \"w\", 0.3], rpy = [0, 0.4, \"v\"], axis = [1, 0, 0] },\n"
      "{ name = \"e\", xyz = [0.4, 0, 0], axis = [0, 1, 0] },\n"
      "{ name = \"f\", xyz = [0, 0.05, \"u\"], axis = [3, 0, 4] },\n]\n"
      "tool = { xyz = [\"w\", 0, 0.1], rpy = [\"u\", 0, 0] }\n"
      "[motion.there]\ntool = [0.3, 0.4, 0.5, 0.1, 0.2, 0.3]\n";
  return read_solve_request(options, {});
}

/// Moves a number, and returns by how much.
double move_exactly(GiNaC::ex& number, double by) {
  constexpr long kParts = 1L << 30;
  const long parts = std::lround(by * double(kParts));
  number += GiNaC::numeric(parts) / GiNaC::numeric(kParts);
  return double(parts) / double(kParts);
}

/// At a point the equations of any arm within the tolerances are in core + Σ by_datum·deviation.
void expect_spread(const RootSystem::Values& at, const std::vector<Interval>& exact,
                   const std::vector<double>& deviations) {
  const std::size_t m = deviations.size();
  ASSERT_EQ(at.by_datum.size(), exact.size() * m);
  ASSERT_EQ(at.data.size(), m);
  for (std::size_t e = 0; e < exact.size(); ++e) {
    Interval value = at.core[e];
    for (std::size_t k = 0; k < m; ++k) value += at.by_datum[e * m + k] * Interval(deviations[k]);
    EXPECT_FALSE(certain_disjoint(value, exact[e])) << e;
    EXPECT_TRUE(certain_subset(Interval(mid(exact[e])), at.value[e]));
    EXPECT_LT(width_ru(value), 0.2);
  }
}

RootSystem::Values at_point(RootSystem& system, const std::vector<Interval>& point) {
  system.evaluate({&point, 1}, false);
  return system.at(0).value();
}

ArmLoop loop_of(const ArmAtPlace& arm) { return {arm.chain, arm.target, arm.target_rates}; }

TEST(AnArmWithinTolerances, SaysAtAPointHowEachMovesItsEquations) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> part(-1, 1), angle(-3, 3);
  for (const std::string kind : {"", ", type = \"prismatic\""}) {
    const Request request = plain_arm(kind);
    const ArmAtPlace within = arm_at_place(request, {});
    ASSERT_EQ(within.deviations.size(), 3U);
    for (int trial = 0; trial < 40; ++trial) {
      Model other = request.model;
      std::vector<double> deviations;
      for (std::size_t k = 0; k < other.geometry.size(); ++k) {
        const double by = within.deviations[k].hi * (trial % 2 == 0 ? part(random) : 0.99);
        deviations.push_back(move_exactly(other.geometry[k].value, by));
      }
      const ArmAtPlace arm = nominal_arm_at_place(request, {}, other);
      std::vector<Interval> six;
      for (std::size_t k = 0; k < kJoints; ++k) six.emplace_back(angle(random));
      expect_spread(at_point(*within.equations(false), six),
                    at_point(*arm.equations(false), six).value, deviations);
      const std::vector<Interval> four(six.begin(), six.begin() + 4);
      OppositeAxes all(std::make_shared<OppositeEquations>(
          VaryingLoop{loop_of(within), loop_of(*within.nominal), within.deviations}));
      OppositeAxes one(std::make_shared<OppositeEquations>(VaryingLoop{loop_of(arm), {}, {}}));
      expect_spread(at_point(all, four), at_point(one, four).value, deviations);
    }
  }
}

/// Joints that are left out have the values of the posture, wherever the others and the geometry are.
TEST(AnArmWithinTolerances, EnclosesTheJointsThatFollow) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(-1, 1), angle(-3, 3);
  int narrow = 0;
  for (const std::string kind : {"", ", type = \"prismatic\""})
    for (int trial = 0; trial < 60; ++trial) {
      const Request request = plain_arm(kind);
      ArmAtPlace within = arm_at_place(request, {});
      std::vector<Interval> posture;
      for (std::size_t k = 0; k < kJoints; ++k) posture.emplace_back(angle(random));
      Model other = request.model;
      for (std::size_t k = 0; k < other.geometry.size(); ++k)
        move_exactly(other.geometry[k].value, within.deviations[k].hi * part(random));
      // The end of this arm is at the place of the other one.
      within.target = posture_at(nominal_arm_at_place(request, {}, other).chain, posture).end;
      within.target_rates.clear();
      for (const std::size_t number : systems_without_two(within)) {
        const DividedUnknowns divided = divided_unknowns(within, number);
        std::vector<Interval> searched;
        for (const std::size_t k : divided.searched)
          searched.push_back(posture[k] + Interval(-0.01, 0.02));
        const auto values = enclose_following(within, number, searched);
        if (!values) continue;
        for (std::size_t i = 0; i < 2; ++i) {
          const std::size_t k = divided.following[i];
          const Interval gap = (*values)[i] - posture[k], turn = Interval(2.0) * kPi;
          const double turns = within.unknowns[k].turns ? std::round(mid(gap) / mid(turn)) : 0;
          EXPECT_TRUE(contains_zero(gap - Interval(turns) * turn)) << number << " " << k;
          narrow += width_ru(gap) < 1;
        }
      }
    }
  EXPECT_GT(narrow, 100);
}

}  // namespace
}  // namespace regulus::detail
