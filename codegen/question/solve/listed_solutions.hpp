// SPDX-License-Identifier: GPL-3.0-or-later
// The lines `solution` and `from` of the certificate of a list that a search proves.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "codegen/model/request.hpp"
#include "codegen/question/solve/solutions.hpp"

namespace regulus::detail {

/// The values of solutions in the lines of a list.
struct Listed {
  std::vector<std::vector<Interval>> tubes;  ///< by solution and unknown
  std::vector<double> sizes;                 ///< a usual size of each unknown
  /// Of solutions that were followed: where they are at the middles of what is uncertain.
  std::vector<std::vector<double>> middles{};
};

/// Returns the values of the solutions as the certificate has them: angles in radians, and within a turn.
[[nodiscard]] Listed list_of(const Request& request, const Solutions& solutions);

/// Returns the lines `solution`. Those of solutions that were followed are only so much wider that they
/// stay apart.
///
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] std::string lines_of(const Solutions& solutions, const Listed& listed);

/// The same, each interval wider by a part of its own width and a part of the widest of its solution; nullopt: two
/// lines would overlap.
[[nodiscard]] std::optional<std::string> wider_lines_of(const Solutions& solutions,
                                                        const Listed& listed, double own,
                                                        double widest);

/// Returns the proof of a search: empty but for where solutions were followed from.
[[nodiscard]] std::string proof_of(const Listed& listed);

/// Returns the question about configurations at one place: an unknown that turns is looked for within
/// half a turn of the middle of its range, another one in its range.
[[nodiscard]] Request searched_request(const Request& request);

/// Returns how far the platform may be from the base.
[[nodiscard]] double size_of(const Request& request, const Solutions& solutions);

/// Of the size of an unknown: lines are at least so much wider than the enclosures.
inline constexpr double kWiderForSearch = 0x1p-36;

}  // namespace regulus::detail
