// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/start_test.hpp"

#include <cmath>

#include "runtime/interval/floating_point_scope.hpp"

namespace regulus::detail {
namespace {

constexpr const char* kNotOne =
    "the values of 'start' are not shown to be near exactly one configuration; regulus solve lists "
    "the "
    "configurations of that place; give the digits of one, or a 'radius' that reaches exactly one";
constexpr const char* kNone =
    "no configuration was found within the 'radius' of the values of 'start'; regulus solve lists "
    "the "
    "configurations of that place; give the digits of one";

/// All values within the radius, without slopes.
BranchTube tube_of(const BranchStart& start) {
  BranchTube tube;
  for (const Interval& x : start.place) tube.at.push_back(mid(x));
  for (std::size_t i = 0; i < start.values.size(); ++i) {
    const Interval& r = start.radius[i];
    const Interval all = start.values[i] + Interval(-r.hi, r.hi);
    tube.center.push_back(mid(all)), tube.radius.push_back(rad_ru(all));
  }
  tube.slopes.assign(tube.center.size() * tube.at.size(), 0.0);
  return tube;
}

bool has_one_start(SystemBoxes& system, const BranchStart& start) {
  const BranchTube tube = tube_of(start);
  SystemBoxes::Box center, over;
  for (std::size_t k = 0; k < start.place.size(); ++k) {
    center.emplace_back(tube.at[k]);
    over.push_back(hull(start.place[k], Interval(tube.at[k])));
  }
  for (const double p : tube.center) center.emplace_back(p);
  const std::vector<Interval> unknowns = enclose(tube, over);
  over.insert(over.end(), unknowns.begin(), unknowns.end());
  const std::vector<SystemBoxes::Box> boxes{center, over};
  system.evaluate(boxes);
  const auto at_center = system.at(0), all = system.at(1);
  if (!at_center || !all) return false;
  std::vector<double> matrix;
  for (const Interval& entry : at_center->by_unknown) matrix.push_back(mid(entry));
  const auto inverse = approx_inverse_of(matrix, tube.center.size());
  return inverse &&
         has_one_solution(tube, image_of(tube, start.place, *inverse,
                                         {at_center->value, all->by_unknown, all->by_variable}));
}

/// Newton's method ends within the radius.
bool is_near_one(SystemBoxes& system, const ClosedShape& shape, const BranchStart& start) {
  BranchPoint near;
  for (const Interval& x : start.place) near.variables.push_back(mid(x));
  for (const Interval& p : start.values) near.unknowns.push_back(mid(p));
  const auto settled = settle(system, shape, {&near, 1});
  if (!settled[0]) return false;
  for (std::size_t i = 0; i < near.unknowns.size(); ++i)
    if (!(std::fabs(settled[0]->at.unknowns[i] - near.unknowns[i]) <= start.radius[i].hi))
      return false;
  return true;
}

}  // namespace

std::string obstacle_of_start(SystemBoxes& system, const ClosedShape& shape,
                              const BranchStart& start) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  if (has_one_start(system, start)) return "";
  return is_near_one(system, shape, start) ? kNotOne : kNone;
}

}  // namespace regulus::detail
