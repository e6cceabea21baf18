// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/degrees.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "codegen/model/exact/expression_parser.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/exact/sign.hpp"

namespace regulus {
namespace {

bool is_plain(const GiNaC::ex& e) { return e.info(GiNaC::info_flags::rational); }

}  // namespace

GiNaC::ex one_degree() { return GiNaC::Pi / 180; }

bool is_in_degrees(std::string_view unit) noexcept { return unit == "deg" || unit == "°"; }

bool is_like_degrees(std::string_view unit) noexcept {
  constexpr std::array<std::string_view, 6> kOthers = {"degree", "degrees", "Deg",
                                                       "DEG",    "Degree",  "Degrees"};
  return std::ranges::find(kOthers, unit) != kOthers.end();
}

void warn_about_angle(std::vector<std::string>& warnings, const Range& range, std::string_view unit,
                      const Place& place) {
  if (unit != "rad" && !is_in_degrees(unit)) return;
  const bool in_degrees = is_in_degrees(unit);
  for (const GiNaC::ex& end : {range.hi, range.lo}) {
    const std::optional<double> value = approx_value(end);
    if (!value || std::fabs(*value) <= (in_degrees ? 360 : kOneTurn)) continue;
    const std::string shown = is_plain(end) ? formula_text(end) : fmt::format("{:.6g}", *value);
    std::string warning =
        place.file.empty() ? "" : place.file + ":" + std::to_string(place.line) + ": ";
    warning += place.key + " is " + shown + (in_degrees ? " deg" : " rad") + ", more than a turn";
    if (!in_degrees && is_plain(end))
      warning += "; if degrees are meant, write \"" + shown + "deg\"";
    warnings.push_back(std::move(warning));
    return;
  }
}

}  // namespace regulus
