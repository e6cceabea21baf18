// SPDX-License-Identifier: GPL-3.0-or-later
// The test of second order, on equations whose solutions are known: p³ + p = x, and two of them that
// are coupled by a rotation.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "runtime/existence/branch_tube.hpp"

namespace regulus::detail {
namespace {

/// p³ + p for an interval: it increases.
Interval cubic(Interval p) { return pow(p, 3) + p; }
Interval first(Interval p) { return Interval(3.0) * sqr(p) + Interval(1.0); }
Interval second(Interval p) { return Interval(6.0) * p; }

double solution(double x) {
  double p = x / (1 + std::fabs(x));
  for (int i = 0; i < 60; ++i) p -= (p * p * p + p - x) / (3 * p * p + 1);
  return p;
}

/// u = c·p − s·q and v = s·p + c·q solve u³ + u = x and v³ + v = y.
struct Rotated {
  double c, s;

  struct Values {
    std::vector<Interval> value, by_unknown, by_variable, rates_by_unknown, rates_by_variable;
  };
  [[nodiscard]] Values over(std::span<const Interval> box) const {
    const Interval u = Interval(c) * box[2] - Interval(s) * box[3],
                   v = Interval(s) * box[2] + Interval(c) * box[3];
    Values values;
    values.value = {cubic(u) - box[0], cubic(v) - box[1]};
    values.by_unknown = {first(u) * Interval(c), first(u) * Interval(-s), first(v) * Interval(s),
                         first(v) * Interval(c)};
    values.by_variable = {-1.0, 0.0, 0.0, -1.0};
    values.rates_by_unknown.assign(8, 0.0);  // by x and y
    for (const auto& [du, dv] : {std::pair(c, s), std::pair(-s, c)})
      for (const Interval& rate :
           {second(u) * Interval(du) * Interval(c), second(u) * Interval(du) * Interval(-s),
            second(v) * Interval(dv) * Interval(s), second(v) * Interval(dv) * Interval(c)})
        values.rates_by_unknown.push_back(rate);
    values.rates_by_variable.assign(16, 0.0);
    return values;
  }
};

struct Tried {
  bool plain = false, second_order = false;
  BranchTube tube;
};

std::vector<double> middles(const std::vector<Interval>& values) {
  std::vector<double> result;
  for (const Interval& value : values) result.push_back(mid(value));
  return result;
}

/// Tries radii for the box with the centre at its middle.
Tried try_radii(const Rotated& system, const std::vector<Interval>& box) {
  BranchTube tube;
  tube.at = {mid(box[0]), mid(box[1])};
  const double u = solution(tube.at[0]), v = solution(tube.at[1]);
  tube.center = {system.c * u + system.s * v, -system.s * u + system.c * v};
  const auto at =
      system.over(std::vector<Interval>{tube.at[0], tube.at[1], tube.center[0], tube.center[1]});
  const std::vector<double> inverse = *approx_inverse_of(middles(at.by_unknown), 2);
  tube.slopes = inverse;  // Φ_x = −I
  Tried tried;
  for (double radius = 1e-6; radius < 1; radius *= 1.5) {
    tube.radius = {radius, radius};
    std::vector<Interval> reach = box;
    for (const Interval& unknown : enclose(tube, box)) reach.push_back(unknown);
    const auto over = system.over(reach);
    const TubeSystem plain{at.value, over.by_unknown, over.by_variable};
    TubeSystem rates = plain;
    rates.center_by_unknown = at.by_unknown, rates.center_by_variable = at.by_variable;
    rates.rates_by_unknown = over.rates_by_unknown;
    rates.rates_by_variable = over.rates_by_variable;
    const TubeImage wide = image_of(tube, box, inverse, plain),
                    narrow = image_of(tube, box, inverse, rates);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_LE(narrow.radius[i], wide.radius[i]);
      EXPECT_LE(narrow.change[i], wide.change[i]);
    }
    tried.plain = tried.plain || has_one_solution(tube, wide);
    if (has_one_solution(tube, narrow)) {
      if (!tried.second_order) tried.tube = tube;
      tried.second_order = true;
    }
  }
  return tried;
}

TEST(SecondOrderTube, HoldsTheKnownSolution) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-2, 2), width(0.01, 1.5), angle(0, 3);
  int plain = 0, second_order = 0;
  for (int count = 0; count < 400; ++count) {
    const double turn = angle(random), x = place(random), y = place(random), w = width(random);
    const Rotated system{std::cos(turn), std::sin(turn)};
    const std::vector<Interval> box{Interval(x, x + w), Interval(y, y + w * 0.7)};
    const Tried tried = try_radii(system, box);
    plain += tried.plain, second_order += tried.second_order;
    if (!tried.second_order) continue;
    const double norm = system.c * system.c + system.s * system.s;
    for (int i = 0; i < 20; ++i) {
      std::uniform_real_distribution<double> part(0, 1);
      const double px = x + w * part(random), py = y + 0.7 * w * part(random);
      const double u = solution(px), v = solution(py);
      const std::vector<Interval> at{px, py};
      const std::vector<Interval> unknowns = enclose(tried.tube, at);
      EXPECT_NEAR((system.c * u + system.s * v) / norm, mid(unknowns[0]),
                  rad_ru(unknowns[0]) + 1e-12);
      EXPECT_NEAR((-system.s * u + system.c * v) / norm, mid(unknowns[1]),
                  rad_ru(unknowns[1]) + 1e-12);
    }
  }
  EXPECT_GT(plain, 40);
  EXPECT_GT(second_order, plain + 20);
}

/// p² = x has two solutions, and none below 0; p = 0 is a double one.
TEST(SecondOrderTube, FindsNoSolutionWhereThereAreTwoOrNone) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> place(-0.5, 2), center(-1, 1), half(1e-3, 1.5);
  int found = 0;
  for (int count = 0; count < 20000; ++count) {
    const double x = place(random), width = 0.2 * half(random);
    const std::vector<Interval> box{Interval(x, x + width)};
    BranchTube tube{{mid(box[0])}, {center(random)}, {half(random)}, {half(random)}};
    const Interval p = enclose(tube, box)[0];
    const std::vector<Interval> value{sqr(Interval(tube.center[0])) - Interval(tube.at[0])},
        by_unknown{Interval(2.0) * p}, by_variable{-1.0}, at{Interval(2 * tube.center[0])},
        rates_by_unknown{0.0, 2.0}, rates_by_variable{0.0, 0.0};
    const std::vector<double> inverse{1 / (2 * tube.center[0])};
    const TubeSystem system{value,       by_unknown,       by_variable,      at,
                            by_variable, rates_by_unknown, rates_by_variable};
    if (!has_one_solution(tube, image_of(tube, box, inverse, system))) continue;
    ++found;
    for (const double at_x : {x, x + width}) {
      ASSERT_GT(at_x, 0);
      const Interval range = enclose(tube, std::vector<Interval>{at_x})[0];
      const int roots = contains(range, std::sqrt(at_x)) + contains(range, -std::sqrt(at_x));
      EXPECT_EQ(roots, 1);
    }
  }
  EXPECT_GT(found, 50);
}

}  // namespace
}  // namespace regulus::detail
