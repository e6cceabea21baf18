// SPDX-License-Identifier: GPL-3.0-or-later
// Values of the uncertain quantities of a closure. In boxes a point in a ball is anywhere in the box
// around it; what is claimed of one value must be about one in the ball.
#pragma once

#include <vector>

#include "codegen/question/closure/closure_run.hpp"

namespace regulus::detail {

/// Brings each point of a ball that is beyond it into it, a little below its surface.
///
/// Shape     uncertain: by variable after the motion parameters, or empty.
[[nodiscard]] std::vector<double> within_balls(const PreparedClosure& prepared,
                                               std::vector<double> uncertain);

/// True if these are values of the uncertain quantities for certain.
[[nodiscard]] bool are_possible(const PreparedClosure& prepared,
                                const std::vector<double>& uncertain);

/// True if a point, of the variables and then the unknowns, meets the constraints for certain, and the
/// uncertain quantities have such values.
[[nodiscard]] bool is_in_motion(const PreparedClosure& prepared, SystemBoxes& system,
                                const std::vector<Interval>& point);

/// Replaces points in balls by the farthest ones in the direction of `along`, or against it.
///
/// Shape     along: by variable; corner: as `uncertain` above.
void aim_at_balls(const PreparedClosure& prepared, const std::vector<double>& along, bool is_with,
                  std::vector<double>& corner);

}  // namespace regulus::detail
