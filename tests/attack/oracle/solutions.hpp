// SPDX-License-Identifier: GPL-3.0-or-later
// What is known of all solutions of a system, and whether a list contradicts it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/attack/oracle/value.hpp"

namespace regulus::detail::attack {

/// Values of the unknowns, by name.
using Solution = std::map<std::string, Value>;

struct SolveTruth {
  std::vector<Solution> known;  ///< pairwise different; each is a solution
  /// Regular solutions that were found in doubles, and are known to 1e-6.
  std::vector<std::map<std::string, double>> near;
  std::optional<std::size_t> count;  ///< of all solutions that a list must have, if it is known
  bool is_degenerate = false;        ///< one is multiple or not isolated: no list can be complete
  std::map<std::string, std::string> periods;  ///< expressions; by the unknowns that turn
  bool has_opposites = false;                  ///< q and −q are one rotation
  std::vector<std::string> equations;  ///< expressions of the unknowns that are 0 at `known`
};

/// The list of a report: enclosures by unknown.
struct ListedSolutions {
  std::string verdict;  ///< "complete", "none" or "incomplete"
  std::vector<std::map<std::string, std::pair<double, double>>> solutions;
};

/// Returns why the list is false, or nullopt.
[[nodiscard]] std::optional<std::string> refute_list(const SolveTruth& truth,
                                                     const ListedSolutions& listed);

/// Returns why the truth is false: an equation that does not hold, or more solutions than the count.
[[nodiscard]] std::optional<std::string> refute_solutions(const SolveTruth& truth);

}  // namespace regulus::detail::attack
