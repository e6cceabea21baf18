// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers in reports.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/interval/interval.hpp"

namespace regulus::detail {

/// Returns [lo, hi], 0 without a sign; an infinite bound becomes null, because JSON has no infinities.
[[nodiscard]] nlohmann::ordered_json json_interval(const Interval& x);

/// Returns "1 box", "2 boxes".
[[nodiscard]] std::string counted(std::uint64_t count, const char* one, const char* many);
/// Returns "50 000".
[[nodiscard]] std::string in_thousands(std::uint64_t count);
/// Returns " cm", for example; nothing for the unit 1.
[[nodiscard]] std::string unit_suffix(const std::string& unit);

/// Returns the shortest decimal that reads as this double.
[[nodiscard]] std::string shortest_text(double x);
/// Returns the shortest decimal that reads as a double of the interval; for −x, the same with the
/// other sign.
[[nodiscard]] std::string shortest_text_in(const Interval& x);
/// Returns "3" for equal ends, otherwise "[3, 4]".
[[nodiscard]] std::string ends_text(const std::string& lo, const std::string& hi);

/// Returns a short text for people; never used for certified values.
[[nodiscard]] std::string short_interval(const Interval& x);
/// Returns the shortest decimal of a value that is known to six digits or more, otherwise both ends.
[[nodiscard]] std::string value_text(const Interval& x);
/// Returns the threshold in a claim, with six digits, or more if needed to be within the enclosure.
/// It uses the end that claims less: the lower one in "|det| > α", the upper one in "|det| ≤ α".
[[nodiscard]] std::string threshold_text(const Interval& alpha, bool exceeded);

}  // namespace regulus::detail
