// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers that say where a robot is: its pose parameters, or in their place the lengths of its legs
// or the place of its tool.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "codegen/model/request.hpp"

namespace regulus::detail {

struct PlaceName {
  std::string name, unit;
};

/// Returns rho_1, rho_2 …, the lengths of Model::legs; empty if the model has none. If a pose parameter
/// has such a name, they are leg_rho_1 …
[[nodiscard]] std::vector<PlaceName> length_names(const Model& model);
/// Returns x, y, z, roll, pitch, yaw, of the tool of an arm; empty if the model is none. If a joint has
/// such a name, they are tool_x …
[[nodiscard]] std::vector<PlaceName> tool_names(const Model& model);
/// Returns the pose parameters.
[[nodiscard]] std::vector<PlaceName> pose_names(const Model& model);

/// A number of a place: a text, as options have it, or a value in the unit of its name.
struct GivenNumber {
  std::string name, text{};
  std::optional<GiNaC::ex> value{};
};

/// Returns the motion that is meant: the one that the options name, or the only one. If they name none,
/// and there is a number for each pose parameter, length or coordinate of the tool, it is a motion
/// of its own.
///
/// Throws    InputError that lists the names.
[[nodiscard]] Motion asked_motion(const Model& model, const ModelOptions& options,
                                  std::span<const GivenNumber> given);

/// True if a motion by the place of an arm's tool gives a joint a value, which it keeps.
[[nodiscard]] bool keeps_value(const Model& model, const Motion& motion, std::size_t joint);

/// Sets a number of the motion's place. A pose parameter may have a range "LO:HI" as text. Beside the
/// place of a tool, a joint may have a value that it keeps.
///
/// Throws    InputError if the motion has no such number.
void set_number(const Model& model, Motion& motion, const GivenNumber& given);

/// Returns the model of the options. Throws as read_request().
[[nodiscard]] Model read_model(std::string_view text, const ModelOptions& options,
                               const FormingWatch* watch);

/// Returns the request of the options about a model that is read; `more` numbers follow those of
/// ModelOptions::at. They take the place of way-points, if the options take places (takes_legs). Throws as
/// read_request(), and InputError without a file for one of `more`.
[[nodiscard]] Request request_of(Model model, const ModelOptions& options,
                                 std::span<const GivenNumber> more = {});

/// Returns the file of the motion that the options mean, if it is along way-points; "": it is not.
/// Throws as request_of().
[[nodiscard]] std::string waypoints_of(const Model& model, const ModelOptions& options);

/// A number of the place of a motion.
struct PlacedNumber {
  std::string name, unit;
  GiNaC::ex value;  ///< in that unit
};

/// Requires  the parameters of the motion have values.
[[nodiscard]] std::vector<PlacedNumber> place_of(const Model& model, const Motion& motion);

}  // namespace regulus::detail
