// SPDX-License-Identifier: GPL-3.0-or-later
// The pose and the uncertain values of a witness of a quantity.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "codegen/question/engine/pipeline.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::detail {

/// The place where an end of a bracket is attained, for people and for programs.
struct AttainedPlace {
  std::string pose;    ///< "x = -5, y = 5, z = 50"
  std::string values;  ///< of loads and other uncertain quantities: lines, or empty
  nlohmann::ordered_json json;
};

/// Returns the place of the witness of `result` without `parameter`, the r of question/quantity/bordered.hpp,
/// which says nothing about the robot; "every pose" if there is no witness.
///
/// Requires  the variety of `preparation` is that of the search.
[[nodiscard]] AttainedPlace attained_place(const PreparedSearch& preparation, const Result& result,
                                           const std::string& parameter);

}  // namespace regulus::detail
