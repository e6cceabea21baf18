// SPDX-License-Identifier: GPL-3.0-or-later
// Expressions as an author writes them in C++. See AUTHORS.md.
#pragma once

#include <ginac/ginac.h>

#include <concepts>
#include <string>
#include <string_view>
#include <vector>

#include "codegen/model/source_place.hpp"

namespace regulus::inline model {

/// An expression of a model that is written in C++: what a model file would say in its place.
///
/// It is kept as text and read by the reader of model files, so that both mean the same: numbers
/// are exact, and what must be defined for the expression as it is written stays known. (GiNaC
/// would make 1 of x/x and x of sqrt(x)^2 before anybody could ask whether they are defined.)
class Formula {
 public:
  using Place = SourcePlace;

  /// 0.
  Formula() : Formula(0) {}

  template <std::integral Whole>
  requires(!std::same_as<Whole, bool> && !std::same_as<Whole, char>) Formula(Whole value)
      : Formula(std::to_string(value), value < 0 ? kSum : kPrimary) {}

  /// A double is not the number that was typed: write 0.1_exact or "0.1"; exact_value_of(x) for the
  /// binary number that the double x is.
  template <class Rounded>
  requires(std::floating_point<Rounded> || std::same_as<Rounded, bool> ||
           std::same_as<Rounded, char>) Formula(Rounded)
  = delete;

  /// An expression of model files: "0.1", "1/3", "-10*deg", "x - h*cos(phi)".
  ///
  /// Throws    InputError, with the place in C++, for what is not arithmetic.
  Formula(const char* text, Place place = Place::current());
  Formula(const std::string& text, Place place = Place::current());

  /// The expression as GiNaC has simplified it; what must be defined for the one that was written
  /// is what its form shows. Throws InputError for what model files have no words for: a
  /// floating-point number, a complex one, another function.
  Formula(const GiNaC::ex& value, Place place = Place::current());
  Formula(const GiNaC::basic& value, Place place = Place::current());

  [[nodiscard]] const std::string& text() const noexcept { return text_; }
  /// The symbols of GiNaC that were written in it.
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
  /// How tightly the outermost operation of the text binds; see expression_parser.hpp.
  enum Binding { kSum, kProduct, kPower, kPrimary };

  Formula(std::string text, Binding binding) : text_(std::move(text)), binding_(binding) {}
  /// In parentheses if it binds less tightly than that.
  [[nodiscard]] std::string at_least(Binding binding) const;
  [[nodiscard]] static Formula joined(const Formula& a, const char* between, const Formula& b,
                                      Binding binding, Binding left, Binding right);
  [[nodiscard]] static Formula called(const char* function, const Formula& x);
  void add_symbols_of(const Formula& other);

  std::string text_;
  Binding binding_;
  std::vector<GiNaC::ex> symbols_;
};

/// The binary number that a double is, for one that was computed or measured: exact_value_of(0.1)
/// is 3602879701896397/2^55, which is not 1/10. Throws InputError for an infinite one or NaN.
[[nodiscard]] Formula exact_value_of(double value, SourcePlace place = SourcePlace::current());

/// digits [. digits] [(e|E) [+|-] digits] with ' between digits: a decimal that C++ has.
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
  // 017 is fifteen in C++.
  const bool octal = whole_end == text.size() && whole_end > 1 && text.front() == '0';
  return at == text.size() && !octal;
}

inline namespace literals {

/// 0.1_exact is 1/10: the number that is written, which 0.1 is not. Decimals only.
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
}  // namespace regulus::inline model
