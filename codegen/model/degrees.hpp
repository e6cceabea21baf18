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

namespace regulus::inline model {

/// The meaning of numbers that stand alone.
enum class NumberUnit { kPlain, kDegrees };

/// One degree as an angle: Pi/180, exactly.
[[nodiscard]] GiNaC::ex one_degree();

[[nodiscard]] bool is_in_degrees(std::string_view unit) noexcept;

[[nodiscard]] inline NumberUnit number_unit(std::string_view unit) noexcept {
  return is_in_degrees(unit) ? NumberUnit::kDegrees : NumberUnit::kPlain;
}

/// True for a unit that may be meant as degrees but is not the one that is known: "degrees".
[[nodiscard]] bool is_like_degrees(std::string_view unit) noexcept;

/// Returns a note for each angle in radians with a range of plain numbers that is wider than a
/// turn, because degrees may be meant. The joints of an arm may turn four times.
[[nodiscard]] std::vector<std::string> notes_about_angles(const Motion& motion,
                                                          MatrixKind kind = MatrixKind::kInverse);

}  // namespace regulus::model
