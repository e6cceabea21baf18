// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of an arm, within its tolerances, at which a posture is nearer to a singular one.
#pragma once

#include "codegen/question/solve/arm_place.hpp"

namespace regulus::detail {

/// Returns the model with each uncertain quantity at the end of its range at which the posture is nearer to a singular
/// one, by one step each, than it is in the nominal arm.
///
/// Shape     posture: by unknown, of the nominal arm.
/// Rounding  MXCSR at nearest.
[[nodiscard]] Model model_towards_singular(const Request& request,
                                           const std::vector<std::string>& held,
                                           const std::vector<double>& posture);

/// Returns the values of the uncertain quantities: "a2 = 0.44, d4 = 0.42".
[[nodiscard]] std::string uncertain_values_text(const Model& model);

}  // namespace regulus::detail
