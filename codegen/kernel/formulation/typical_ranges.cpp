// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/formulation/typical_ranges.hpp"

#include <cmath>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/exact/decimal.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

/// The digits of a range of one point.
constexpr int kPointBits = 8;

/// Column operations for half of a motion may be bad for the whole of it; those for half of a
/// tolerance hardly differ.
int steps_per_octave(VariableKind kind) { return kind == VariableKind::kMotion ? 8 : 1; }

/// Rounds up to one of the numbers (1 + i/steps)·2^e.
double rounded_up(double x, int steps) {
  const double unit = std::ldexp(1.0, std::ilogb(x)) / steps;
  return unit * std::ceil(x / unit);
}

double multiple_near(double x, double unit) { return unit * std::nearbyint(x / unit); }

Range typical(double lo, double hi, int steps) {
  const double half = hi / 2 - lo / 2, middle = lo / 2 + hi / 2;
  if (!(half > 0)) {
    const double point =
        middle == 0 ? 0 : multiple_near(middle, std::ldexp(1.0, std::ilogb(middle) - kPointBits));
    return {exact_value(point), exact_value(point)};
  }
  // The middle moves by at most a sixteenth of the half-width.
  const double unit = std::ldexp(1.0, std::ilogb(half) - 3);
  const double width = rounded_up(half + unit / 2, steps);
  const GiNaC::ex center = exact_value(multiple_near(middle, unit));
  return {center - exact_value(width), center + exact_value(width)};
}

}  // namespace

std::vector<Variable> with_typical_ranges(std::vector<Variable> variables) {
  for (Variable& v : variables) try {
      const Interval lo = enclose_constant(v.range.lo, v.name);
      const Interval hi = enclose_constant(v.range.hi, v.name);
      if (std::isfinite(lo.lo) && std::isfinite(hi.hi))
        v.range = typical(mid(lo), mid(hi), steps_per_octave(v.kind));
    } catch (const InputError&) {
      // enclose_variety reports a range without a value.
    }
  return variables;
}

}  // namespace regulus::detail
