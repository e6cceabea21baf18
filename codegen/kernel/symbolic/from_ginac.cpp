// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/symbolic/from_ginac.hpp"

#include <cln/complex.h>
#include <cln/integer.h>

#include <array>
#include <sstream>
#include <string>
#include <utility>

#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

[[noreturn]] void refuse(const GiNaC::ex& e, const std::string& expected) {
  std::ostringstream found;
  found << e;
  throw InputError("", 0, "'" + found.str() + "'", expected, found.str());
}

cln::cl_RA rational(const GiNaC::ex& e) {
  const auto& number = GiNaC::ex_to<GiNaC::numeric>(e);
  if (!number.is_rational()) refuse(e, "an exact rational number");
  return cln::the<cln::cl_RA>(number.to_cl_N());
}

constexpr int kLargestExponent = 1 << 20;

cln::cl_RA rational_content(const Expression& sum_expression) {
  cln::cl_I numerator = 0, denominator = 1;
  for (const Expression& term : sum_expression.operands()) {
    const cln::cl_RA c = coefficient_of(term);
    numerator = cln::gcd(numerator, cln::numerator(c));
    denominator = cln::lcm(denominator, cln::denominator(c));
  }
  return numerator / denominator;
}

/// base^exponent with the content and the sign of a sum taken out. GiNaC takes them out too, with
/// the sign of the first term in an order that changes with addresses; of such a sum, a product may
/// be left with that sign where symbols stand for 0.
Expression normalized_power(const Expression& base, int exponent) {
  if (base.kind() == ExpressionKind::kProduct && exponent != 1 && minusp(coefficient_of(base)))
    return product({Expression(exponent % 2 == 0 ? 1 : -1), power(divide_by(base, -1), exponent)});
  if (base.kind() != ExpressionKind::kSum) return power(base, exponent);
  const Signed form = normalize_sign(base);
  const cln::cl_RA content = rational_content(form.form);
  if (zerop(content)) return power(base, exponent);
  const cln::cl_RA factor = cln::expt(form.sign * content, exponent);
  return product({Expression(factor), power(divide_by(form.form, content), exponent)});
}

Expressions normalized_factors(Expressions factors) {
  for (Expression& factor : factors) factor = normalized_power(factor, 1);
  return factors;
}

/// Returns terms c·(a + b) as c·a and c·b. GiNaC does this if it makes a term, but not always if it
/// substitutes a sum for a symbol: that changes with addresses, too.
Expressions distributed(const Expressions& terms) {
  Expressions result;
  for (const Expression& term : terms) {
    const bool is_multiple = term.kind() == ExpressionKind::kProduct &&
                             term.operands().size() == 2 &&
                             term.operands()[0].kind() == ExpressionKind::kConstant &&
                             term.operands()[1].kind() == ExpressionKind::kSum;
    if (!is_multiple) {
      result.push_back(term);
      continue;
    }
    for (const Expression& part : term.operands()[1].operands())
      result.push_back(product({term.operands()[0], part}));
  }
  return result;
}

/// Returns x^(p/q): square roots if q is a power of two (defined for x ≥ 0), else exp(p/q·log x)
/// (for x > 0). The latter is also used for a p beyond the integer exponents of powers, because it
/// is defined at no more points.
Expression fractional_power(const Expression& base, const cln::cl_RA& exponent) {
  const cln::cl_I p = numerator(exponent), q = denominator(exponent);
  const bool roots = cln::logcount(q) == 1 && q <= kLargestExponent && abs(p) <= kLargestExponent;
  if (!roots) return call(Call::kExp, {Expression(exponent) * call(Call::kLog, {base})});
  Expression root = base;
  for (int i = 1; i < q; i *= 2) root = call(Call::kSqrt, {root});
  return power(root, cln::cl_I_to_int(p));
}

struct Named {
  const char* name;
  Call function;
};

constexpr std::array<Named, 10> kFunctions = {{{"sin", Call::kSin},
                                               {"cos", Call::kCos},
                                               {"tan", Call::kTan},
                                               {"asin", Call::kAsin},
                                               {"acos", Call::kAcos},
                                               {"atan", Call::kAtan},
                                               {"atan2", Call::kAtan2},
                                               {"exp", Call::kExp},
                                               {"log", Call::kLog},
                                               {"abs", Call::kAbs}}};

}  // namespace

Expression GinacReader::read(const GiNaC::ex& e) {
  if (GiNaC::is_a<GiNaC::numeric>(e)) return Expression(rational(e));
  if (const auto found = known_.find(e); found != known_.end()) return found->second;
  spend(meter_, 1 + e.nops());
  Expression result = converted(e);
  known_.emplace(e, result);
  return result;
}

Expression GinacReader::converted(const GiNaC::ex& e) {
  if (GiNaC::is_a<GiNaC::symbol>(e)) {
    const auto meaning = symbols_.find(e);
    if (meaning == symbols_.end()) refuse(e, "a pose, geometry or motion parameter");
    return meaning->second;
  }
  if (e.is_equal(GiNaC::Pi)) return pi();
  if (GiNaC::is_a<GiNaC::add>(e)) return sum(distributed(read_operands(e)));
  if (GiNaC::is_a<GiNaC::mul>(e)) return product(normalized_factors(read_operands(e)));
  if (GiNaC::is_a<GiNaC::power>(e)) return read_power(e);
  if (GiNaC::is_a<GiNaC::function>(e)) return read_function(e);
  refuse(e, "an arithmetic expression");
}

Expressions GinacReader::read_operands(const GiNaC::ex& e) {
  Expressions operands;
  operands.reserve(e.nops());
  for (std::size_t i = 0; i < e.nops(); ++i) operands.push_back(read(e.op(i)));
  return operands;
}

Expression GinacReader::read_power(const GiNaC::ex& e) {
  if (!e.op(1).info(GiNaC::info_flags::rational)) refuse(e, "a rational exponent");
  const cln::cl_RA n = rational(e.op(1));
  const Expression base = read(e.op(0));
  if (denominator(n) != 1) return fractional_power(base, n);
  if (abs(n) > kLargestExponent) refuse(e, "an integer exponent of moderate size");
  return normalized_power(base, cln::cl_I_to_int(numerator(n)));
}

Expression GinacReader::read_function(const GiNaC::ex& e) {
  const std::string name = GiNaC::ex_to<GiNaC::function>(e).get_name();
  for (const Named& known : kFunctions)
    if (name == known.name) return call(known.function, read_operands(e));
  refuse(e, "one of the functions sqrt sin cos tan asin acos atan atan2 exp log abs");
}

}  // namespace regulus::detail
