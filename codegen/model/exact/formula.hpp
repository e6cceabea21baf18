// SPDX-License-Identifier: GPL-3.0-or-later
// Expressions as an author writes them in C++. See AUTHORS.md.
#pragma once

#include <ginac/ginac.h>

#include <concepts>
#include <string>
#include <string_view>
#include <vector>

#include "codegen/model/source_place.hpp"
#include "codegen/support/infix_text.hpp"

namespace regulus {

/// An expression of a model that is written in C++, as the text that a model file would have.
///
/// The reader of model files reads this text, so that both mean the same: numbers are exact, and
/// the parts that must be defined in the written expression stay known. (GiNaC would simplify x/x
/// to 1 and sqrt(x)^2 to x, and the conditions for them to be defined would be lost.)
class Formula {
 public:
  using Place = SourcePlace;

  /// 0.
  Formula() : Formula(0) {}

  template <std::integral Whole>
  requires(!std::same_as<Whole, bool> && !std::same_as<Whole, char>) Formula(Whole value)
      : Formula(std::to_string(value), value < 0 ? Precedence::kSum : Precedence::kPrimary) {}

  /// Deleted, because a double is not the number that was typed: write 0.1_exact or "0.1". For the
  /// exact binary value of a double x, write exact_value_of(x).
  template <class Rounded>
  requires(std::floating_point<Rounded> || std::same_as<Rounded, bool> ||
           std::same_as<Rounded, char>) Formula(Rounded)
  = delete;

  /// An expression of model files: "0.1", "1/3", "-10*deg", "x - h*cos(phi)".
  ///
  /// Throws    InputError, with the place in C++, for a text that is not arithmetic.
  Formula(const char* text, Place place = Place::current());
  Formula(const std::string& text, Place place = Place::current());

  /// The expression as GiNaC has simplified it; only the conditions that its form shows are known.
  /// Throws    InputError for anything that model files cannot express: a floating-point number, a
  ///           complex number, another function.
  Formula(const GiNaC::ex& value, Place place = Place::current());
  Formula(const GiNaC::basic& value, Place place = Place::current());

  [[nodiscard]] const std::string& text() const noexcept { return text_.text; }
  /// The symbols of GiNaC in it.
  [[nodiscard]] const std::vector<GiNaC::ex>& symbols() const noexcept { return symbols_; }

  Formula operator-() const;
  friend Formula operator+(const Formula& a, const Formula& b);
  friend Formula operator-(const Formula& a, const Formula& b);
  friend Formula operator*(const Formula& a, const Formula& b);
  friend Formula operator/(const Formula& a, const Formula& b);
  Formula& operator+=(const Formula& b) { return *this = *this + b; }
  Formula& operator-=(const Formula& b) { return *this = *this - b; }
  Formula& operator*=(const Formula& b) { return *this = *this * b; }
  Formula& operator/=(const Formula& b) { return *this = *this / b; }

  /// base^exponent; the exponent a rational number.
  friend Formula pow(const Formula& base, const Formula& exponent);
  friend Formula sqrt(const Formula& x);
  friend Formula sin(const Formula& x);
  friend Formula cos(const Formula& x);
  friend Formula tan(const Formula& x);
  friend Formula asin(const Formula& x);
  friend Formula acos(const Formula& x);
  friend Formula atan(const Formula& x);
  friend Formula atan2(const Formula& y, const Formula& x);
  friend Formula exp(const Formula& x);
  friend Formula log(const Formula& x);
  friend Formula abs(const Formula& x);

 private:
  Formula(std::string text, Precedence precedence) : text_{std::move(text), precedence} {}
  [[nodiscard]] static Formula joined(const Formula& a, const char* between, const Formula& b,
                                      Precedence precedence, Precedence left, Precedence right);
  [[nodiscard]] static Formula called(const char* function, const Formula& x);
  void add_symbols_of(const Formula& other);

  InfixText text_;
  std::vector<GiNaC::ex> symbols_;
};

/// The exact binary value of a computed or measured double: exact_value_of(0.1) is
/// 3602879701896397/2^55, which is not 1/10. Throws InputError for infinities and NaN.
[[nodiscard]] Formula exact_value_of(double value, SourcePlace place = SourcePlace::current());

/// An expression that no line of a C++ program states, but a robot's file.
template <class Value>
[[nodiscard]] Formula unplaced(const Value& value) {
  return Formula(value, SourcePlace());
}

/// True for a decimal literal of C++: digits [. digits] [(e|E) [+|-] digits], with ' between
/// digits.
[[nodiscard]] constexpr bool is_decimal_literal(std::string_view text) noexcept {
  std::size_t at = 0;
  const auto is_digit = [&text](std::size_t i) { return '0' <= text[i] && text[i] <= '9'; };
  const auto skip_digits = [&] {
    const std::size_t begin = at;
    while (at < text.size() && (is_digit(at) || text[at] == '\'')) ++at;
    return at > begin;
  };
  const bool whole = skip_digits();
  const std::size_t whole_end = at;
  bool fraction = false;
  if (at < text.size() && text[at] == '.') ++at, fraction = skip_digits();
  if (!whole && !fraction) return false;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    if (!skip_digits()) return false;
  }
  // In C++, 017 is fifteen.
  const bool octal = whole_end == text.size() && whole_end > 1 && text.front() == '0';
  return at == text.size() && !octal;
}

inline namespace literals {

/// 0.1_exact is exactly 1/10; 0.1 is not. Decimals only.
template <char... kText>
[[nodiscard]] Formula operator""_exact() {
  constexpr char kCharacters[] = {kText..., '\0'};
  static_assert(is_decimal_literal({kCharacters, sizeof...(kText)}),
                "_exact takes a decimal: 0.1_exact, 15_exact, 1e-3_exact");
  std::string text;
  for (const char c : {kText...})
    if (c != '\'') text += c;
  return Formula(text);
}

}  // namespace literals
}  // namespace regulus
