// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/degrees.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "codegen/model/exact/expression_parser.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/exact/sign.hpp"

namespace regulus::detail {
namespace {

bool is_plain(const GiNaC::ex& e) { return e.info(GiNaC::info_flags::rational); }

/// True for a number as people write degrees: with at most two decimals, and no quarter turns, which
/// are written in radians, as in 6.28.
bool may_be_degrees(const GiNaC::ex& e) {
  if (!is_plain(e) || !GiNaC::ex(100 * e).info(GiNaC::info_flags::integer)) return false;
  const double value = GiNaC::ex_to<GiNaC::numeric>(e).to_double();
  const double quarters = std::fabs(value) / (std::numbers::pi / 2);
  return value == 0 || std::round(quarters) == 0 ||
         std::fabs(quarters - std::round(quarters)) > 0.005;
}

std::string decimal_text(const GiNaC::ex& e) {
  return fmt::format("{}", GiNaC::ex_to<GiNaC::numeric>(e).to_double() + 0.0);
}

}  // namespace

GiNaC::ex one_degree() { return GiNaC::Pi / 180; }

bool is_in_degrees(std::string_view unit) noexcept { return unit == "deg" || unit == "°"; }

bool is_like_degrees(std::string_view unit) noexcept {
  constexpr std::array<std::string_view, 6> kOthers = {"degree", "degrees", "Deg",
                                                       "DEG",    "Degree",  "Degrees"};
  return std::ranges::find(kOthers, unit) != kOthers.end();
}

void warn_about_angle(std::vector<std::string>& warnings, const Range& range, std::string_view unit,
                      const Place& place, bool is_of_joint) {
  if (unit != "rad" && !is_in_degrees(unit)) return;
  const bool in_degrees = is_in_degrees(unit);
  const std::string label = in_degrees ? " deg" : " rad";
  const auto warn = [&](const std::string& words) {
    warnings.push_back(
        (place.file.empty() ? "" : place.file + ":" + std::to_string(place.line) + ": ") +
        place.key + " is " + words);
  };
  for (const GiNaC::ex& end : {range.hi, range.lo}) {
    const std::optional<double> value = approx_value(end);
    if (!value || std::fabs(*value) <= (in_degrees ? 360 : kOneTurn)) continue;
    const std::string shown = is_plain(end) ? formula_text(end) : fmt::format("{:.6g}", *value);
    const bool has_hint = !in_degrees && is_plain(end);
    return warn(shown + label + ", more than a turn" +
                (has_hint ? "; if degrees are meant, write \"" + shown + "deg\"" : ""));
  }
  if (in_degrees || is_of_joint || !may_be_degrees(range.lo) || !may_be_degrees(range.hi) ||
      GiNaC::ex_to<GiNaC::numeric>(range.hi - range.lo).to_double() <= kOneTurn)
    return;
  const std::string lo = decimal_text(range.lo), hi = decimal_text(range.hi);
  warn(
      fmt::format("[{}, {}] rad, wider than a turn; if degrees are meant, write \"{}deg\" and "
                  "\"{}deg\"",
                  lo, hi, lo, hi));
}

}  // namespace regulus::detail
