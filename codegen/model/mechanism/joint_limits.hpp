// SPDX-License-Identifier: GPL-3.0-or-later
// The limits of an arm's joints as the frame of its questions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "codegen/model/model.hpp"

namespace regulus::detail {

/// A place where a motion leaves the limits of a joint.
struct Excursion {
  std::string joint;
  std::string sentence;  ///< "q2 takes 1.5 rad, beyond its limits [-1, 1] rad"
  std::string file{};    ///< of way-points; empty: the motion's own
  int line = 0;
};

/// Returns the ranges of the motion `limits`, in the order of the pose, if it is a box; else nothing.
[[nodiscard]] std::vector<Range> limits_of_joints(const Model& model);

/// Returns a place where the commanded poses of the motion leave Model::limits; control errors are
/// deviations from them.
///
/// Ensures   the place is proved. For ranges, values, and way-points along straight lines, nullopt is
///           proved as well, as far as signs are; other formulas are tried at sample poses.
[[nodiscard]] std::optional<Excursion> find_excursion(const Model& model, const Motion& motion);

/// Returns true if the range is shown to leave the limits.
[[nodiscard]] bool leaves(const Range& range, const Range& limits);

}  // namespace regulus::detail
