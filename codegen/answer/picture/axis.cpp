// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/picture/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "codegen/answer/report/number_text.hpp"

namespace regulus {
namespace {

/// Returns the exponent of the axis: 0 where plain numbers are short.
int exponent_of(const Interval& range) {
  constexpr int kShortest = -2, kLongest = 4;
  const double largest = std::max(std::abs(range.lo), std::abs(range.hi));
  if (largest == 0 || !std::isfinite(largest)) return 0;
  const int exponent = int(std::floor(std::log10(largest)));
  return exponent < kShortest || exponent > kLongest ? exponent : 0;
}

std::string superscript(int number) {
  constexpr std::string_view kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = number < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(number))) text += kDigits[digit - '0'];
  return text;
}

}  // namespace

Axis::Axis(Interval range, const std::string& name, const std::string& unit) : range_(range) {
  std::string scale = unit_suffix(unit);
  if (!scale.empty()) scale.erase(0, 1);
  if (const int exponent = exponent_of(range); exponent != 0) {
    factor_ = std::pow(10.0, -exponent);
    scale = fmt::format("× 10{}{}{}", superscript(exponent), scale.empty() ? "" : " ", scale);
  }
  label_ = scale.empty() ? name : fmt::format("{} ({})", name, scale);
}

std::string Axis::ends(Interval x) const {
  return fmt::format("{:.9g} {:.9g}", x.lo * factor_, x.hi * factor_);
}

std::string Axis::range_command(const char* axis) const {
  return fmt::format("set {}range [{:.9g}:{:.9g}]\n", axis, range_.lo * factor_,
                     range_.hi * factor_);
}

Axis axis_of(const SearchSubject& p, std::size_t variable) {
  const VariableLabel& label = p.labels.variables[variable];
  return {p.variety.outer[variable], label.name, label.unit};
}

}  // namespace regulus
