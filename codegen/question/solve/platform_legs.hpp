// SPDX-License-Identifier: GPL-3.0-or-later
// The legs of a platform in enclosures: at the nominal values, or anywhere within tolerances and errors.
#pragma once

#include <vector>

#include "codegen/model/request.hpp"
#include "runtime/solutions/gough_poses.hpp"

namespace regulus {

/// Returns the square of each length at the nominal values.
[[nodiscard]] std::vector<GiNaC::ex> squared_lengths(const Request& request);

/// Encloses the legs at the nominal values of the geometry, with the lengths of the motion, or at its pose.
///
/// Requires  six legs.
[[nodiscard]] GoughLegs enclose_legs(const Request& request);

/// The same with the geometry anywhere within its tolerances, and lengths within their errors, or those at
/// poses within the control errors. The legs of enclose_legs() are among these.
[[nodiscard]] GoughLegs enclose_uncertain_legs(const Request& request);

/// True if the model or the motion has a tolerance or an error that is not 0.
[[nodiscard]] bool has_tolerances(const Request& request);

}  // namespace regulus
