// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/exact/ginac_text.hpp"

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>

#include "codegen/model/exact/real_functions.hpp"
#include "codegen/support/infix_text.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_a;
using GiNaC::numeric;

std::string printed(const ex& e) {
  std::ostringstream text;
  text << e;
  return text.str();
}

using enum Precedence;

/// A sign and a text that has none in front.
struct SignedText : InfixText {
  SignedText(bool sign, std::string unsigned_text, Precedence of = kPrimary)
      : InfixText{std::move(unsigned_text), of}, negative(sign) {}

  bool negative;
};

SignedText signed_text(const ex& e);

/// The terms in the order of their texts.
std::vector<SignedText> ordered_terms(const ex& sum) {
  std::vector<SignedText> terms;
  for (const ex& term : sum) terms.push_back(signed_text(term));
  std::ranges::sort(terms, {}, &InfixText::text);
  return terms;
}

std::string joined(const std::vector<SignedText>& terms, bool negated) {
  std::string text;
  for (const SignedText& term : terms) {
    const bool negative = term.negative != negated;
    if (!text.empty()) text += negative ? " - " : " + ";
    if (text.empty() && negative) text += '-';
    text += term.at_least(kProduct);
  }
  return text;
}

SignedText number_text(const numeric& value) {
  if (!value.is_real())
    throw ParseRefusal{"the complex number " + printed(value), "a model over the reals"};
  if (!value.is_rational())
    throw ParseRefusal{"the floating-point number " + printed(value) + ", which has been rounded",
                       "an exact one: GiNaC::numeric(1, 10), 0.1_exact, or the text \"0.1\""};
  return {value.is_negative(), printed(abs(value)), value.is_integer() ? kPrimary : kProduct};
}

/// GiNaC writes (a - b)^2 or (b - a)^2 according to its own order of a and b. Here the first term
/// in the order of texts is positive.
SignedText power_text(const ex& base, const ex& exponent) {
  if (exponent.is_equal(numeric(1, 2))) return {false, "sqrt" + in_parentheses(formula_text(base))};
  const SignedText n = signed_text(exponent);
  std::string to = "^";
  to += n.negative ? in_parentheses(formula_text(exponent)) : n.at_least(kPrimary);
  if (is_a<GiNaC::add>(base) && exponent.info(GiNaC::info_flags::integer)) {
    const std::vector<SignedText> terms = ordered_terms(base);
    const bool negated = terms.front().negative;
    const bool odd = exponent.info(GiNaC::info_flags::odd);
    return {negated && odd, in_parentheses(joined(terms, negated)) + to, kPower};
  }
  const SignedText b = signed_text(base);
  const std::string of = b.negative ? in_parentheses(formula_text(base)) : b.at_least(kPrimary);
  return {false, of + to, kPower};
}

SignedText product_text(const ex& product) {
  SignedText result{false, "", kProduct};
  std::vector<std::string> factors;
  for (const ex& factor : product) {
    const SignedText text = signed_text(factor);
    result.negative = result.negative != text.negative;
    if (text.text != "1") factors.push_back(text.at_least(kPower));
  }
  std::ranges::sort(factors);
  for (const std::string& factor : factors)
    result.text += (result.text.empty() ? "" : "*") + factor;
  return result;
}

SignedText call_text(const GiNaC::function& call) {
  const std::string name = call.get_name();
  if (!is_function(name))
    throw ParseRefusal{"the function " + name, "one of those that model files have"};
  std::string arguments;
  for (const ex& argument : call)
    arguments += (arguments.empty() ? "" : ", ") + formula_text(argument);
  return {false, name + in_parentheses(arguments)};
}

SignedText signed_text(const ex& e) {
  if (is_a<numeric>(e)) return number_text(ex_to<numeric>(e));
  if (is_a<GiNaC::symbol>(e)) return {false, ex_to<GiNaC::symbol>(e).get_name()};
  if (e.is_equal(GiNaC::Pi)) return {false, "pi"};
  if (is_a<GiNaC::add>(e)) return {false, joined(ordered_terms(e), false), kSum};
  if (is_a<GiNaC::mul>(e)) return product_text(e);
  if (is_a<GiNaC::power>(e)) return power_text(e.op(0), e.op(1));
  if (is_a<GiNaC::function>(e)) return call_text(ex_to<GiNaC::function>(e));
  throw ParseRefusal{printed(e), "arithmetic on numbers, symbols and the functions of model files"};
}

void collect(const ex& e, std::set<ex, GiNaC::ex_is_less>& symbols) {
  if (is_a<GiNaC::symbol>(e)) symbols.insert(e);
  for (const ex& operand : e) collect(operand, symbols);
}

}  // namespace

std::string formula_text(const ex& e) {
  const SignedText text = signed_text(e);
  return text.negative ? std::string("-").append(text.at_least(kProduct)) : text.text;
}

std::vector<ex> symbols_of(const ex& expression) {
  std::set<ex, GiNaC::ex_is_less> found;
  collect(expression, found);
  return {found.begin(), found.end()};
}

}  // namespace regulus::detail
