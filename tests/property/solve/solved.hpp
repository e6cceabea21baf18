// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "codegen/question/solve/solve_run.hpp"

namespace regulus::detail::test {

/// Solves a model at the places "NAME=VALUE", or for its only motion.
inline Solutions solved(const std::string& text, const std::vector<std::string>& at = {},
                        std::uint64_t max_boxes = 0) {
  SearchOptions search;
  search.engine = Engine::kInterpreted;
  search.threads = 1;
  search.time_limit = 60;
  search.max_boxes = max_boxes;
  ModelOptions options;
  options.text = text;
  options.at = at;
  return solve(read_solve_request(options, {}), SolveRun{search, {}});
}

inline bool is_complete(const Solutions& solutions) {
  return solutions.completeness == Completeness::kComplete;
}

/// True if some solution encloses numbers near these.
inline bool has_near(const Solutions& solutions, const std::vector<double>& values,
                     double distance = 1e-9) {
  for (const CertainSolution& s : solutions.found) {
    bool is_near = true;
    for (std::size_t i = 0; i < values.size(); ++i) {
      double gap = values[i] - mid(s.values[i]);
      const double period = solutions.unknowns[i].period;
      if (period > 0) gap = std::remainder(gap, period);
      is_near = is_near && std::fabs(gap) <= distance + rad_ru(s.values[i]);
    }
    if (is_near) return true;
  }
  return false;
}

}  // namespace regulus::detail::test
