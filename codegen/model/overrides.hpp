// SPDX-License-Identifier: GPL-3.0-or-later
// The changes of a command line to a model: ranges, threshold, tolerances. All texts may be
// expressions ("-5*deg:5*deg"); a mistake throws InputError without a file.
#pragma once

#include <string>
#include <string_view>

#include "codegen/model/model.hpp"

namespace regulus::detail {

/// Returns the motion of that name; for an empty name, the only motion. Throws InputError that
/// lists the names.
[[nodiscard]] const Motion& find_motion(const Model& model, std::string_view name = {});

/// Sets the range of a motion parameter, "LO:HI" or "V", in the unit of the parameter. A pose parameter that is constant in the
/// motion becomes a motion parameter.
void set_range(const Model& model, Motion& motion, const std::string& parameter,
               std::string_view range);
/// The same with a range in the unit of the parameter.
void set_range(const Model& model, Motion& motion, const std::string& parameter,
               const Range& range);

/// Sets the control errors of pose parameters: "p,q=E" of those named, in their unit, "E" of all,
/// which must then have one unit.
void set_tube(const Model& model, Motion& motion, std::string_view tube);

void set_alpha(Motion& motion, std::string_view alpha);

/// Requires  alpha ≥ 0.
void set_alpha(Motion& motion, const GiNaC::ex& alpha);

/// Sets the tolerance, or the radius of the balls, of every member of the groups: a comma list such
/// as "base,platform". Throws InputError that lists the groups if one is unknown, and if only some of
/// their members take degrees.
void set_tolerance(Model& model, std::string_view groups, std::string_view tolerance);

/// The same; a number of degrees if the members of the groups take degrees.
///
/// Requires  tolerance ≥ 0.
void set_tolerance(Model& model, std::string_view groups, const GiNaC::ex& tolerance);

/// The groups of the model, each once, in the order of the geometry.
[[nodiscard]] std::vector<std::string> tolerance_groups(const Model& model);

}  // namespace regulus::detail
