// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/exact/sign.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>

namespace regulus::detail {
namespace {

using GiNaC::ex;
using GiNaC::is_a;

template <typename Predicate>
bool all_operands(const ex& e, Predicate predicate) {
  return std::all_of(e.begin(), e.end(), predicate);
}

const GiNaC::numeric* numeric_exponent(const ex& power) {
  const ex& exponent = power.op(1);
  return is_a<GiNaC::numeric>(exponent) ? &GiNaC::ex_to<GiNaC::numeric>(exponent) : nullptr;
}

/// True for powers that are never negative: even powers, and roots, which are defined only for a
/// base that is not negative.
bool is_even_or_root(const GiNaC::numeric& exponent) {
  return exponent.is_even() || (exponent.is_rational() && !exponent.is_integer());
}

bool is_function_named(const ex& e, const char* name) {
  return is_a<GiNaC::function>(e) && GiNaC::ex_to<GiNaC::function>(e).get_name() == name;
}

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

double approx(const ex& e);

double approx_call(const GiNaC::function& f) {
  const double x = approx(f.op(0));
  const std::string name = f.get_name();
  if (name == "sin") return std::sin(x);
  if (name == "cos") return std::cos(x);
  if (name == "tan") return std::tan(x);
  if (name == "asin") return std::asin(x);
  if (name == "acos") return std::acos(x);
  if (name == "atan") return std::atan(x);
  if (name == "atan2") return std::atan2(x, approx(f.op(1)));
  if (name == "exp") return std::exp(x);
  if (name == "log") return std::log(x);
  return name == "abs" ? std::fabs(x) : kNoValue;
}

/// NaN or infinite if some part of e is.
double approx(const ex& e) {
  if (is_a<GiNaC::numeric>(e))
    return e.info(GiNaC::info_flags::real) ? GiNaC::ex_to<GiNaC::numeric>(e).to_double() : kNoValue;
  if (e.is_equal(GiNaC::Pi)) return std::numbers::pi;
  const auto of_operands = [&e](double start, auto operation) {
    return std::accumulate(e.begin(), e.end(), start, [&](double so_far, const ex& operand) {
      return operation(so_far, approx(operand));
    });
  };
  if (is_a<GiNaC::add>(e)) return of_operands(0.0, std::plus<>());
  if (is_a<GiNaC::mul>(e)) return of_operands(1.0, std::multiplies<>());
  if (is_a<GiNaC::power>(e)) return std::pow(approx(e.op(0)), approx(e.op(1)));
  return is_a<GiNaC::function>(e) ? approx_call(GiNaC::ex_to<GiNaC::function>(e)) : kNoValue;
}

}  // namespace

bool certain_nonnegative(const ex& e) {
  if (is_a<GiNaC::numeric>(e)) return e.info(GiNaC::info_flags::nonnegative);
  if (is_a<GiNaC::add>(e) || is_a<GiNaC::mul>(e)) return all_operands(e, certain_nonnegative);
  if (is_a<GiNaC::power>(e)) {
    const GiNaC::numeric* exponent = numeric_exponent(e);
    return exponent && (is_even_or_root(*exponent) || certain_nonnegative(e.op(0)));
  }
  return e.is_equal(GiNaC::Pi) || is_function_named(e, "exp") || is_function_named(e, "abs") ||
         is_function_named(e, "acos");
}

bool certain_positive(const ex& e) {
  if (is_a<GiNaC::numeric>(e)) return e.info(GiNaC::info_flags::positive);
  if (is_a<GiNaC::add>(e))
    return all_operands(e, certain_nonnegative) &&
           std::any_of(e.begin(), e.end(), certain_positive);
  if (is_a<GiNaC::mul>(e)) return all_operands(e, certain_positive);
  if (is_a<GiNaC::power>(e)) {
    const GiNaC::numeric* exponent = numeric_exponent(e);
    if (!exponent) return false;
    return certain_positive(e.op(0)) || (exponent->is_negative() && is_even_or_root(*exponent));
  }
  return e.is_equal(GiNaC::Pi) || is_function_named(e, "exp");
}

bool certain_defined(const ex& e) {
  if (!all_operands(e, certain_defined)) return false;
  if (is_a<GiNaC::power>(e)) {
    const GiNaC::numeric* exponent = numeric_exponent(e);
    if (!exponent) return false;
    if (exponent->is_pos_integer()) return true;
    return exponent->is_positive() ? certain_nonnegative(e.op(0)) : certain_positive(e.op(0));
  }
  if (!is_a<GiNaC::function>(e)) return true;
  const auto is_total = [&e](const char* name) { return is_function_named(e, name); };
  return is_total("sin") || is_total("cos") || is_total("atan") || is_total("exp") ||
         is_total("abs");
}

std::optional<double> approx_value(const ex& constant) {
  const double value = approx(constant);
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

}  // namespace regulus::detail
