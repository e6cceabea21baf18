// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/exact/domain.hpp"

#include <fmt/format.h>

#include "codegen/model/exact/sign.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

/// A constant is refused early only if it is this far outside a domain. Closer ones are recorded
/// like any other operand, and the certified evaluation decides.
constexpr double kClearlyOutside = 1e-9;

ex square_root(const ex& x) { return GiNaC::pow(x, numeric(1, 2)); }

bool is_number(const ex& e) { return GiNaC::is_a<numeric>(e); }

/// True if lower ≤ x (lower < x if strict) is violated; exact for rationals.
bool violates_lower(const ex& x, bool constant, int lower, bool strict) {
  if (is_number(x)) {
    const numeric& value = GiNaC::ex_to<numeric>(x);
    return strict ? !(value > lower) : !(value >= lower);
  }
  if (!constant) return false;
  const auto value = approx_value(x);
  return !value || *value < lower - kClearlyOutside;
}

void record(ParsedExpression& result, const ex& partial) {
  if (!certain_defined(partial)) result.must_be_defined.push_back(partial);
}

std::string value_text(const ex& constant) {
  const auto value = approx_value(constant);
  return value ? fmt::format(" ({:.12g})", *value) : " (not a finite real number)";
}

}  // namespace

void require_nonzero(ParsedExpression& result, const ex& x, bool constant) {
  if (x.is_zero()) throw ParseRefusal{"a division by zero", "a divisor that is not zero"};
  if (constant && !is_number(x) && !approx_value(x))
    throw ParseRefusal{"a divisor that is not a finite real number", "a finite real divisor"};
  if (is_number(x) || certain_positive(x)) return;
  record(result, GiNaC::pow(x, -1));
}

void require_nonnegative(ParsedExpression& result, const ex& x, bool constant) {
  if (violates_lower(x, constant, 0, false))
    throw ParseRefusal{"the root of a negative number" + value_text(x), "an operand that is ≥ 0"};
  if (is_number(x) || certain_nonnegative(x)) return;
  record(result, square_root(x));
}

void require_positive(ParsedExpression& result, const ex& x, bool constant) {
  if (violates_lower(x, constant, 0, true))
    throw ParseRefusal{"the logarithm or fractional power of a number" + value_text(x),
                       "an operand that is > 0"};
  if (is_number(x) || certain_positive(x)) return;
  record(result, GiNaC::log(x));
}

void require_unit_range(ParsedExpression& result, const ex& x, bool constant) {
  if (violates_lower(x, constant, -1, false) || violates_lower(-x, constant, -1, false))
    throw ParseRefusal{"the arc sine or cosine of a number" + value_text(x),
                       "an operand between -1 and 1"};
  if (is_number(x)) return;
  record(result, GiNaC::asin(x));
}

void require_no_pole_of_tan(ParsedExpression& result, const ex& x) {
  if (is_number(x)) return;  // no rational number equals π/2 + kπ
  record(result, GiNaC::tan(x));
}

void require_off_branch_cut(ParsedExpression& result, const ex& y, const ex& x) {
  if (is_number(y) && is_number(x)) {
    if (y.is_zero() && !x.info(GiNaC::info_flags::positive))
      throw ParseRefusal{"atan2(0, x) with x ≤ 0", "y ≠ 0 or x > 0"};
    return;
  }
  if (certain_positive(x) || certain_positive(y) || certain_positive(-y)) return;
  record(result, GiNaC::atan2(y, x));
}

}  // namespace regulus::detail
