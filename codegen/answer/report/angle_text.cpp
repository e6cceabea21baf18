// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/angle_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "codegen/answer/report/number_text.hpp"

namespace regulus::detail {
namespace {

/// Returns the decimal of at most six digits that is this angle in degrees, if there is one.
std::optional<double> short_degrees(const Interval& radians) {
  // Two roundings: of the factor and of the product.
  const double degree = 180 / std::numbers::pi;
  const double slack = 4 * std::numeric_limits<double>::epsilon() * std::fabs(radians.lo);
  const double lo = (radians.lo - slack) * degree, hi = (radians.hi + slack) * degree;
  double shown = 0;
  const std::string text = fmt::format("{:.6g}", lo / 2 + hi / 2);
  std::from_chars(text.data(), text.data() + text.size(), shown);
  return lo <= shown && shown <= hi ? std::optional(shown) : std::nullopt;
}

}  // namespace

std::string degrees_text(const std::string& unit, const Interval& lower, const Interval& upper) {
  if (unit != "rad" || (lower == Interval(0.0) && upper == Interval(0.0))) return "";
  const auto lo = short_degrees(lower), hi = short_degrees(upper);
  return lo && hi ? fmt::format(" ({} deg)", ends_text(shortest_text(*lo), shortest_text(*hi)))
                  : "";
}

std::string half_width_text(const Interval& range, const std::string& unit) {
  const double half = (range.hi - range.lo) / 2;
  // The ends are rounded, which a narrow range far from 0 shows.
  const double error = 2 * std::numeric_limits<double>::epsilon() *
                       std::max(std::fabs(range.lo), std::fabs(range.hi));
  const Interval about(half - error, half + error);
  return fmt::format("±{:.6g}{}{}", half, unit_suffix(unit), degrees_text(unit, about, about));
}

}  // namespace regulus::detail
