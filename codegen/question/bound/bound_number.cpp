// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/bound_number.hpp"

#include <fmt/format.h>

#include <cmath>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/model/exact/expression_parser.hpp"
#include "codegen/model/exact/sign.hpp"

namespace regulus::detail {
namespace {

/// True if the decimal is certainly on that side of the constant, or equal to it.
bool is_beyond(const std::string& decimal, const BoundEnd& end, RoundTo side) {
  const GiNaC::ex value = parse_constant(decimal, {.file = "", .key = ""}).value;
  const CertainSign sign =
      certain_sign(side == RoundTo::kAbove ? value - end.exact : end.exact - value);
  return sign == CertainSign::kPositive || sign == CertainSign::kZero;
}

std::string decimal_of(double value, int digits) { return fmt::format("{:.{}g}", value, digits); }

}  // namespace

BoundEnd end_at(const GiNaC::ex& exact) {
  return {exact, approx_value(exact).value_or(std::nan(""))};
}

double rounded_number(const BoundEnd& end, RoundTo side) {
  const Interval enclosure = enclose_constant(end.exact, "a bound");
  return side == RoundTo::kAbove ? enclosure.hi : enclosure.lo;
}

std::string rounded_text(const BoundEnd& end, RoundTo side, int digits) {
  const double magnitude = std::abs(end.approx);
  if (magnitude > 0 && std::isfinite(magnitude)) {
    const double step = std::pow(10, std::floor(std::log10(magnitude)) - digits + 1);
    for (const double away : {0.0, 0.5, 1.0, 1.5}) {
      const double moved = end.approx + (side == RoundTo::kAbove ? away : -away) * step;
      const std::string decimal = decimal_of(moved, digits);
      if (is_beyond(decimal, end, side)) return decimal;
    }
  }
  return fmt::format("{}", rounded_number(end, side));
}

}  // namespace regulus::detail
