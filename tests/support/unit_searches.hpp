// SPDX-License-Identifier: GPL-3.0-or-later
// Searches that are cut into units early, one for each way in which a search of units can end.
#pragma once

#include <string>
#include <vector>

#include "tests/support/function_kernel.hpp"

namespace regulus::test {

struct UnitCase {
  std::string name;
  FunctionKernel kernel;
  std::vector<Interval> ranges;
  Settings settings;
  Verdict verdict;
};

inline Settings in_small_units() {
  Settings settings;
  settings.boxes_before_units = 64;
  settings.boxes_of_unit = 24;
  return settings;
}

/// Makes A = [[x, y], [−y, x]] − r·[[1, 0], [0, 1]]: singular only at x = r and y = 0.
inline FunctionKernel singular_at(double r) {
  return {2, 2, 2, [r](const Values& x) {
            return Values{x[0] - Interval(r), x[1], -x[1], x[0] - Interval(r)};
          }};
}

/// Makes det A = x² + y² − 1.
inline FunctionKernel singular_on_circle() {
  return {2, 2, 2, [](const Values& x) { return Values{x[0] + 1.0, x[1], -x[1], x[0] - 1.0}; }};
}

inline Settings without_descents(Settings settings) {
  settings.ingredients.descents = settings.ingredients.corners = false;
  return settings;
}

inline Settings paving(Settings settings) {
  settings.exhaustive = settings.enclose_determinants = true;
  settings.min_relative_width = 0x1p-6;
  return settings;
}

inline std::vector<UnitCase> unit_cases() {
  const Settings units = in_small_units();
  FunctionKernel inside = singular_on_circle();
  inside.with_constraints(1, [](const Values& x) { return Values{sqr(x[0]) + sqr(x[1]) - 0.99}; });
  std::vector<UnitCase> cases;
  cases.push_back(
      {"proof", singular_at(1.0), {{0x1p-30, 0.999999}, {-1, 1}}, units, Verdict::kNoSingularity});
  cases.push_back({"proof within constraints",
                   std::move(inside),
                   {{-2, 2}, {-2, 2}},
                   units,
                   Verdict::kNoSingularity});
  cases.push_back({"witness",
                   singular_on_circle(),
                   {{0.125, 0.70710678}, {0, 0.70710679}},
                   without_descents(units),
                   Verdict::kSingularity});
  cases.push_back({"blocked",
                   singular_at(0.3),
                   {{-1, 1}, {-1, 1}},
                   without_descents(units),
                   Verdict::kPossibleProblem});
  cases.push_back(
      {"paving", singular_on_circle(), {{-2, 2}, {-2, 2}}, paving(units), Verdict::kSingularity});
  Settings budget = units;
  budget.max_boxes = 400;
  cases.push_back({"budget",
                   singular_at(1.0),
                   {{0x1p-30, 0.999999}, {-1, 1}},
                   budget,
                   Verdict::kPossibleProblem});
  return cases;
}

}  // namespace regulus::test
