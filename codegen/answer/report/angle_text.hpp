// SPDX-License-Identifier: GPL-3.0-or-later
// Angles in reports: in radians, and in degrees where these are short numbers.
#pragma once

#include <string>

#include "runtime/interval/interval.hpp"

namespace regulus::detail {

/// Returns " ([-15, 15] deg)" for angles in radians whose ends are short numbers of degrees; else nothing.
[[nodiscard]] std::string degrees_text(const std::string& unit, const Interval& lower,
                                       const Interval& upper);

/// Returns half the width of a range, "±0.05 cm", with six digits; of an angle "±0.01 rad (0.5 deg)".
[[nodiscard]] std::string half_width_text(const Interval& range, const std::string& unit);

}  // namespace regulus::detail
