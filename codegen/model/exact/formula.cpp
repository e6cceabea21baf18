// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/exact/formula.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "codegen/model/exact/decimal.hpp"
#include "codegen/model/exact/expression_parser.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"

namespace regulus {

using namespace detail;

namespace {

/// Gives every name a meaning: the reader of the model checks later which names are declared.
class AnyName final : public Names {
 public:
  const ParsedExpression* find(const std::string& name, int) override {
    const auto at = terms_.find(name);
    if (at != terms_.end()) return &at->second;
    return &terms_.emplace(name, variable(GiNaC::realsymbol(name))).first->second;
  }
  std::vector<std::string> all() const override { return {}; }

 private:
  std::map<std::string, ParsedExpression> terms_;
};

/// Refuses a text such as "1) + (2" at its own place, before it becomes part of another expression.
void require_expression(const std::string& text, const Formula::Place& place) {
  AnyName names;
  static_cast<void>(parse_expression(
      text, names, {.file = place.file_name(), .line = static_cast<int>(place.line())}));
}

bool is_whole_number(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

using enum Precedence;

/// Limits the length: the text of a C++ variable is repeated at each use of it.
void require_short(const std::string& text) {
  if (text.size() <= kLongestExpression) return;
  throw InputError(
      "", 0, "an expression of more than " + std::to_string(kLongestExpression) + " characters",
      "names for its parts: Robot::let");
}

}  // namespace

Formula::Formula(const std::string& text, Place place)
    : text_{text, is_name(text) || is_whole_number(text) ? kPrimary : kSum} {
  require_expression(text, place);
}

Formula::Formula(const char* text, Place place) : Formula(std::string(text), place) {}

Formula::Formula(const GiNaC::basic& value, Place place) : Formula(GiNaC::ex(value), place) {}

Formula::Formula(const GiNaC::ex& value, Place place) try : Formula(formula_text(value), place) {
  symbols_ = symbols_of(value);
} catch (const ParseRefusal& refusal) {
  throw InputError(place.file_name(), static_cast<int>(place.line()), refusal.found,
                   refusal.expected);
}

void Formula::add_symbols_of(const Formula& other) {
  for (const GiNaC::ex& symbol : other.symbols_)
    if (std::ranges::none_of(symbols_, [&](const auto& s) { return s.is_equal(symbol); }))
      symbols_.push_back(symbol);
}

Formula Formula::joined(const Formula& a, const char* between, const Formula& b,
                        Precedence precedence, Precedence left, Precedence right) {
  Formula result(a.text_.at_least(left) + between + b.text_.at_least(right), precedence);
  require_short(result.text_.text);
  result.add_symbols_of(a);
  result.add_symbols_of(b);
  return result;
}

Formula Formula::called(const char* function, const Formula& x) {
  Formula result(function + in_parentheses(x.text_.text), kPrimary);
  require_short(result.text_.text);
  result.symbols_ = x.symbols_;
  return result;
}

Formula Formula::operator-() const {
  Formula result(std::string("-").append(text_.at_least(kProduct)), kSum);
  result.symbols_ = symbols_;
  return result;
}

Formula operator+(const Formula& a, const Formula& b) {
  return Formula::joined(a, " + ", b, kSum, kSum, kProduct);
}

Formula operator-(const Formula& a, const Formula& b) {
  return Formula::joined(a, " - ", b, kSum, kSum, kProduct);
}

Formula operator*(const Formula& a, const Formula& b) {
  return Formula::joined(a, "*", b, kProduct, kProduct, kPower);
}

Formula operator/(const Formula& a, const Formula& b) {
  return Formula::joined(a, "/", b, kProduct, kProduct, kPower);
}

Formula pow(const Formula& base, const Formula& exponent) {
  return Formula::joined(base, "^", exponent, kPower, kPrimary, kPrimary);
}

Formula atan2(const Formula& y, const Formula& x) {
  Formula result = Formula::joined(y, ", ", x, kPrimary, kSum, kSum);
  result.text_.text = "atan2" + in_parentheses(result.text_.text);
  return result;
}

Formula sqrt(const Formula& x) { return Formula::called("sqrt", x); }
Formula sin(const Formula& x) { return Formula::called("sin", x); }
Formula cos(const Formula& x) { return Formula::called("cos", x); }
Formula tan(const Formula& x) { return Formula::called("tan", x); }
Formula asin(const Formula& x) { return Formula::called("asin", x); }
Formula acos(const Formula& x) { return Formula::called("acos", x); }
Formula atan(const Formula& x) { return Formula::called("atan", x); }
Formula exp(const Formula& x) { return Formula::called("exp", x); }
Formula log(const Formula& x) { return Formula::called("log", x); }
Formula abs(const Formula& x) { return Formula::called("abs", x); }

Formula exact_value_of(double value, SourcePlace place) {
  if (!std::isfinite(value))
    throw InputError(place.file_name(), static_cast<int>(place.line()),
                     "a double that is infinite or not a number", "a finite one");
  return Formula(GiNaC::ex(exact_value(value)), place);
}

}  // namespace regulus
