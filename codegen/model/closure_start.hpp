// SPDX-License-Identifier: GPL-3.0-or-later
// The place of a motion where the branch of a mechanism starts.
#pragma once

#include <vector>

#include "codegen/model/model.hpp"

namespace regulus::detail {

/// Returns the values of the motion's parameters at the start of the model's closure, by parameter.
///
/// Requires  the model has a closure.
/// Ensures   each is within its range, and the motion's pose there is the start's: both are proved. One
///           that is no pose parameter is at its lower end: a motion by formulas begins at the start.
/// Throws    InputError, with the motion's name, if the start is no such place of the motion, or if
///           the motion follows way-points.
[[nodiscard]] std::vector<GiNaC::ex> start_of(const Model& model, const Motion& motion);
/// The same of a whole motion. Throws InputError, too, if a constraint is certainly positive at the start.
[[nodiscard]] std::vector<GiNaC::ex> start_within_constraints(const Model& model,
                                                              const Motion& motion);

/// True only if the start certainly meets the constraints of the motion; of uncertain quantities it has the
/// middles, and of errors none. A motion with `reach` does not tell.
///
/// Requires  the model has a closure.
[[nodiscard]] bool is_start_in_motion(const Model& model, const Motion& motion);

/// Proves that a motion along way-points begins at the start of the model's closure.
///
/// Requires  the model has a closure, and the motion a trajectory.
/// Throws    InputError, with the motion's name, if it does not.
void require_way_from_start(const Model& model, const Motion& motion);

}  // namespace regulus::detail
