// SPDX-License-Identifier: GPL-3.0-or-later
// Angles of the pose in degrees.
//
// A pose parameter of the unit `deg` is a number of degrees: its ranges, values, errors and reports
// are. In an expression its name is the angle itself, so that sin and cos mean the same in both
// units. An expression that could be meant in the other unit is refused.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "codegen/model/model.hpp"

namespace regulus::detail {

struct Place;

/// The meaning of numbers that stand alone.
enum class NumberUnit { kPlain, kDegrees };

/// Just above 2π, as files round it; a warning needs no proof.
constexpr double kOneTurn = 6.2832;

/// One degree as an angle: Pi/180, exactly.
[[nodiscard]] GiNaC::ex one_degree();

[[nodiscard]] bool is_in_degrees(std::string_view unit) noexcept;

[[nodiscard]] inline NumberUnit number_unit(std::string_view unit) noexcept {
  return is_in_degrees(unit) ? NumberUnit::kDegrees : NumberUnit::kPlain;
}

/// True for a unit that may be meant as degrees but is not the one that is known: "degrees".
[[nodiscard]] bool is_like_degrees(std::string_view unit) noexcept;

/// Adds a warning, with the line, if an end of the range is an angle beyond a turn, or if the range in
/// plain numbers of radians is wider than one: degrees may be meant. Of one number both ends are it; of a
/// tolerance or an error ±e they are −e and e. Joints of an arm often turn more than once.
void warn_about_angle(std::vector<std::string>& warnings, const Range& range, std::string_view unit,
                      const Place& place, bool is_of_joint = false);

}  // namespace regulus::detail
