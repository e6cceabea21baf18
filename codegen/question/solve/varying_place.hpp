// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "codegen/model/request.hpp"

namespace regulus::detail {

/// Makes each control error of the place of an arm a quantity of its geometry, NAME_error: 0 ± the error, an angle in
/// radians. Motion::added_to_place says to which number each is added. Then the motion has no errors of its own, and
/// whatever holds for the tolerances of the arm holds for them. Other requests stay as they are.
///
/// Throws    UsageError if the model has such a name.
void let_place_vary(Request& request);

/// Returns what is added to a number of the pose; 0: nothing.
[[nodiscard]] GiNaC::ex added_to_pose(const Motion& motion, std::size_t number);
/// Returns the place of the tool within its errors.
[[nodiscard]] std::vector<GiNaC::ex> tool_within_errors(const Motion& motion);

}  // namespace regulus::detail
