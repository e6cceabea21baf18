// SPDX-License-Identifier: GPL-3.0-or-later
// The legs of a platform in enclosures: at the nominal values, or anywhere within tolerances and errors.
#pragma once

#include <vector>

#include "codegen/model/request.hpp"
#include "runtime/solutions/gough_poses.hpp"

namespace regulus::detail {

/// Returns the square of each length at the nominal values.
[[nodiscard]] std::vector<GiNaC::ex> squared_lengths(const Request& request);

/// Returns how far the square of each length is from this at most: with the length within its error, or with the pose
/// within the control errors. It is a little more, so that others can show it.
[[nodiscard]] std::vector<GiNaC::ex> errors_of_squares(const Request& request);

/// Encloses an expression of the geometry for all its values within tolerances. `what`: for a message.
[[nodiscard]] Interval enclose_uncertain(const Model& model, const GiNaC::ex& expression,
                                         const char* what);

/// Encloses the legs at the nominal values of the geometry, with the lengths of the motion, or at its pose.
///
/// Requires  six legs.
[[nodiscard]] GoughLegs enclose_legs(const Request& request);

/// The same with the geometry anywhere within its tolerances, and lengths within their errors, or those at
/// poses within the control errors. The legs of enclose_legs() are among these.
[[nodiscard]] GoughLegs enclose_uncertain_legs(const Request& request);

/// True if the motion has an error that is not 0.
[[nodiscard]] bool has_errors(const Motion& motion);
/// True if the model or the motion has a tolerance or an error that is not 0.
[[nodiscard]] bool has_tolerances(const Request& request);

}  // namespace regulus::detail
