// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluates expressions at points, in doubles and with explicit domains. For tests only.
#pragma once

#include <ginac/ginac.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>

namespace regulus::detail::test {

using Point = std::map<std::string, double>;

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

inline double evaluate_call(const std::string& name, double x, double y) {
  if (name == "sin") return std::sin(x);
  if (name == "cos") return std::cos(x);
  if (name == "tan") return std::tan(x);
  if (name == "asin") return std::asin(x);
  if (name == "acos") return std::acos(x);
  if (name == "atan") return std::atan(x);
  if (name == "atan2") return x == 0 && y <= 0 ? kUndefined : std::atan2(x, y);
  if (name == "exp") return std::exp(x);
  if (name == "log") return x > 0 ? std::log(x) : kUndefined;
  return name == "abs" ? std::fabs(x) : kUndefined;
}

/// Returns the value at the named coordinates; NaN if some part is undefined.
inline double evaluate(const GiNaC::ex& e, const Point& point) {
  if (GiNaC::is_a<GiNaC::numeric>(e))
    return e.info(GiNaC::info_flags::real) ? GiNaC::ex_to<GiNaC::numeric>(e).to_double()
                                           : kUndefined;
  if (e.is_equal(GiNaC::Pi)) return std::numbers::pi;
  if (GiNaC::is_a<GiNaC::symbol>(e)) return point.at(GiNaC::ex_to<GiNaC::symbol>(e).get_name());
  if (GiNaC::is_a<GiNaC::power>(e)) {
    const double base = evaluate(e.op(0), point);
    const double exponent = evaluate(e.op(1), point);
    return base == 0 && exponent < 0 ? kUndefined : std::pow(base, exponent);
  }
  if (GiNaC::is_a<GiNaC::function>(e))
    return evaluate_call(GiNaC::ex_to<GiNaC::function>(e).get_name(), evaluate(e.op(0), point),
                         e.nops() > 1 ? evaluate(e.op(1), point) : 0);
  const bool is_sum = GiNaC::is_a<GiNaC::add>(e);
  if (!is_sum && !GiNaC::is_a<GiNaC::mul>(e)) return kUndefined;
  double result = is_sum ? 0 : 1;
  for (const GiNaC::ex& operand : e)
    result = is_sum ? result + evaluate(operand, point) : result * evaluate(operand, point);
  return result;
}

}  // namespace regulus::detail::test
