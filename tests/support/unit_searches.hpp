// SPDX-License-Identifier: GPL-3.0-or-later
// Searches that are cut into units early, one for each way in which a search of units can end.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/support/function_kernel.hpp"

namespace regulus::detail::test {

struct UnitCase {
  std::string name;
  std::shared_ptr<const FunctionKernel> kernel;
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
inline std::shared_ptr<FunctionKernel> singular_at(double r) {
  return std::make_shared<FunctionKernel>(2, 2, 2, [r](const Values& x) {
    return Values{x[0] - Interval(r), x[1], -x[1], x[0] - Interval(r)};
  });
}

/// Makes det A = x² + y² − 1.
inline std::shared_ptr<FunctionKernel> singular_on_circle() {
  return std::make_shared<FunctionKernel>(2, 2, 2, [](const Values& x) {
    return Values{x[0] + 1.0, x[1], -x[1], x[0] - 1.0};
  });
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
  Settings budget = units;
  budget.max_boxes = 400;
  const std::vector<Interval> beside{{0x1p-30, 1 - 0x1p-34}, {-1, 1}}, around{{-2, 2}, {-2, 2}};
  const auto near = singular_at(1.0);
  const auto within = singular_at(0.3);
  const auto circle = singular_on_circle();
  const auto disc = singular_on_circle();
  disc->with_constraints(1, [](const Values& x) { return Values{sqr(x[0]) + sqr(x[1]) - 0.99}; });
  return {
      {"proof", near, beside, units, Verdict::kNoSingularity},
      {"proof within constraints", disc, around, units, Verdict::kNoSingularity},
      {"witness",
       circle,
       {{0.125, 0.70710678}, {0, 0.70710679}},
       without_descents(units),
       Verdict::kSingularity},
      {"blocked", within, {{-1, 1}, {-1, 1}}, without_descents(units), Verdict::kPossibleProblem},
      {"paving", circle, around, paving(units), Verdict::kSingularity},
      {"budget", near, beside, budget, Verdict::kPossibleProblem},
  };
}

}  // namespace regulus::detail::test
