// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/exact_number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "codegen/model/exact/decimal.hpp"
#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using GiNaC::numeric;

constexpr int kMostDecimals = 20;    ///< that a number is snapped to
constexpr int kFewer = 1000;         ///< snapping saves more decimals than this has zeros
constexpr int kMillion = 1'000'000;  ///< no length moves by more than its reciprocal
constexpr long kMostTwelfths = 1'000'000;

/// pi to 45 decimals. It decides what is snapped, and what is written afterwards is exact.
numeric approx_pi() {
  return {
      "3141592653589793238462643383279502884197169399/"
      "1000000000000000000000000000000000000000000000"};
}

/// Returns the integer nearest to a rational.
numeric nearest_integer(const numeric& value) {
  const numeric doubled = value * 2 + 1;
  const numeric below = GiNaC::iquo(doubled.numer(), doubled.denom() * 2);
  const bool exact = (doubled / 2 - below).is_zero();
  return doubled.is_negative() && !exact ? below - 1 : below;
}

/// True for digits [. digits] or . digits, with an exponent.
bool is_decimal(std::string_view text) {
  std::size_t at = 0, digits = 0;
  const auto skip = [&] {
    const std::size_t begin = at;
    while (at < text.size() && '0' <= text[at] && text[at] <= '9') ++at;
    return at - begin;
  };
  digits += skip();
  if (at < text.size() && text[at] == '.') ++at, digits += skip();
  if (digits == 0) return false;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    if (skip() == 0) return false;
  }
  return at == text.size();
}

std::string remedy_for(std::string_view text) {
  if (text.find("${") != std::string_view::npos || text.find("$(") != std::string_view::npos)
    return "expand the macros first: xacro FILE.xacro > FILE.urdf";
  if (text.find(',') != std::string_view::npos)
    return "write decimals with a point, and spaces between numbers";
  return std::string("write a decimal with ") + kNumberLimits;
}

}  // namespace

double WrittenNumber::approx() const { return GiNaC::ex_to<numeric>(value.evalf()).to_double(); }

numeric exact_number(std::string_view text, const XmlPlace& place) {
  std::string_view digits = text;
  const bool negative = digits.starts_with('-');
  if (negative || digits.starts_with('+')) digits.remove_prefix(1);
  const auto value = is_decimal(digits) ? exact_decimal(digits) : std::nullopt;
  if (!value)
    throw InputError::statement(place.file, place.line,
                                place.what + " has " + in_quotes(text) + ", which is not a number",
                                remedy_for(text));
  const numeric largest = GiNaC::ex_to<numeric>(GiNaC::pow(GiNaC::ex(10), 100));
  if (*value > largest)
    throw InputError::statement(place.file, place.line,
                                place.what + " has " + in_quotes(text) + ", which is above 1e100",
                                "correct the number");
  return negative ? -*value : *value;
}

std::string decimal_text(const numeric& value) {
  numeric scaled = abs(value);
  std::size_t decimals = 0;
  for (; !scaled.is_integer(); ++decimals) scaled *= 10;
  std::string digits = GiNaC::ex(scaled).is_zero() ? "0" : "";
  for (numeric rest = scaled; !rest.is_zero(); rest = GiNaC::iquo(rest, 10))
    digits += static_cast<char>('0' + GiNaC::irem(rest, 10).to_int());
  while (digits.size() <= decimals) digits += '0';
  std::ranges::reverse(digits);
  if (decimals > 0) digits.insert(digits.size() - decimals, ".");
  return (value.is_negative() ? "-" : "") + digits;
}

WrittenNumber whole(long value) { return {value, std::to_string(value)}; }

WrittenNumber negated(const WrittenNumber& number) {
  if (number.is_zero()) return number;
  if (number.text.starts_with('-')) return {-number.value, number.text.substr(1)};
  return {-number.value, "-" + number.text};
}

WrittenNumber twelfths_of_pi(long k) {
  if (k == 0) return {};
  const long common = std::gcd(k, 12L), p = k / common, q = 12 / common;
  std::string text = p == 1 ? "pi" : p == -1 ? "-pi" : fmt::format("{}*pi", p);
  if (q != 1) text += fmt::format("/{}", q);
  return {GiNaC::Pi * numeric(k, 12), std::move(text)};
}

std::vector<std::string_view> words_of(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  std::vector<std::string_view> words;
  for (std::size_t begin = text.find_first_not_of(kSpace); begin != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kSpace, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(kSpace, end);
  }
  return words;
}

/// The number with the fewest decimals within the tolerance. A number that is only a few decimals
/// longer is meant as it is: 0.28358 is not 0.2836.
WrittenNumber NumberReader::snapped(const numeric& value, std::string_view text,
                                    const XmlPlace& place, const numeric& tolerance) {
  numeric unit = 1;
  if (!tolerance.is_zero())
    for (int decimals = 0; decimals <= kMostDecimals; ++decimals, unit /= 10) {
      const numeric near = nearest_integer(value / unit) * unit;
      if (abs(near - value) > tolerance) continue;
      if (numeric(value / unit * kFewer).is_integer()) break;
      if (!(near - value).is_zero())
        snaps_.push_back({place.line, place.what, std::string(text), decimal_text(near)});
      return {near, decimal_text(near)};
    }
  return {value, decimal_text(value)};
}

WrittenNumber NumberReader::length(std::string_view text, const XmlPlace& place) {
  const numeric most(1, kMillion);
  return snapped(exact_number(text, place), text, place, tolerance_ < most ? tolerance_ : most);
}

WrittenNumber NumberReader::component(std::string_view text, const XmlPlace& place) {
  return snapped(exact_number(text, place), text, place, tolerance_);
}

WrittenNumber NumberReader::angle(std::string_view text, AngleUnit unit, const XmlPlace& place) {
  const numeric written = exact_number(text, place);
  const bool degrees = unit == AngleUnit::kDegree;
  const numeric radian = degrees ? written * approx_pi() / 180 : written;
  const numeric twelfth = approx_pi() / 12;
  const numeric k = nearest_integer(degrees ? written / 15 : written / twelfth);
  const bool exact = degrees && (k * 15 - written).is_zero();
  if (abs(k) <= kMostTwelfths && (exact || abs(k * twelfth - radian) <= tolerance_)) {
    WrittenNumber result = twelfths_of_pi(k.to_long());
    if (!exact && !(k.is_zero() && written.is_zero()))
      snaps_.push_back({place.line, place.what, std::string(text), result.text});
    return result;
  }
  // Whole degrees, as limits often are.
  const numeric degree = approx_pi() / 180, whole_degrees = nearest_integer(radian / degree);
  if (!degrees && !whole_degrees.is_zero() && abs(whole_degrees * degree - radian) <= tolerance_ &&
      abs(k) <= kMostTwelfths) {
    WrittenNumber result{GiNaC::Pi * whole_degrees / 180, decimal_text(whole_degrees) + "*deg"};
    snaps_.push_back({place.line, place.what, std::string(text), result.text});
    return result;
  }
  if (!tolerance_.is_zero() && !k.is_zero() && abs(k * twelfth - radian) <= numeric(1, 10000) &&
      abs(k) <= kMostTwelfths)
    note_near({place.line, place.what, std::string(text), twelfths_of_pi(k.to_long()).text}, -4);
  WrittenNumber result = snapped(written, text, place, tolerance_);
  if (degrees) result = {result.value * GiNaC::Pi / 180, result.text + "*deg"};
  return result;
}

std::vector<WrittenNumber> NumberReader::lengths(std::string_view text, const XmlPlace& place) {
  std::vector<WrittenNumber> numbers;
  for (const std::string_view word : words_of(text)) numbers.push_back(length(word, place));
  return numbers;
}

std::vector<WrittenNumber> NumberReader::angles(std::string_view text, AngleUnit unit,
                                                const XmlPlace& place) {
  std::vector<WrittenNumber> numbers;
  for (const std::string_view word : words_of(text)) numbers.push_back(angle(word, unit, place));
  return numbers;
}

}  // namespace regulus::detail
