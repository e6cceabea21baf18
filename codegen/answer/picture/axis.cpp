// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/picture/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "codegen/answer/report/number_text.hpp"

namespace regulus::detail {
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

/// Returns the distance of ticks: 1, 2 or 5 times a power of ten, or a usual number of degrees.
double step_of(double width, int most_ticks, bool is_angle) {
  if (is_angle)
    for (const double degrees : {1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 90.0, 180.0})
      if (width > most_ticks && width <= most_ticks * degrees) return degrees;
  const double power = std::pow(10.0, std::floor(std::log10(width / most_ticks)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (width <= most_ticks * digit * power) return digit * power;
  return 10 * power;
}

}  // namespace

Axis::Axis(Interval range, const std::string& name, const std::string& unit, int most_ticks,
           const std::optional<Interval>& shown)
    : range_(range),
      shown_(shown.value_or(range)),
      is_angle_(unit == "rad"),
      most_ticks_(most_ticks) {
  if (is_angle_) factor_ = 180 / std::numbers::pi;
  std::string scale = unit_suffix(is_angle_ ? "deg" : unit);
  if (!scale.empty()) scale.erase(0, 1);
  const Interval numbers(shown_.lo * factor_, shown_.hi * factor_);
  if (const int exponent = exponent_of(numbers); exponent != 0) {
    factor_ *= std::pow(10.0, -exponent);
    scale = fmt::format("× 10{}{}{}", superscript(exponent), scale.empty() ? "" : " ", scale);
  }
  label_ = scale.empty() ? name : fmt::format("{} ({})", name, scale);
}

std::string Axis::ends(Interval x) const {
  return fmt::format("{:.9g} {:.9g}", x.lo * factor_, x.hi * factor_);
}

std::string Axis::range_command(const char* axis) const {
  const double lo = shown_.lo * factor_, hi = shown_.hi * factor_;
  std::string command = fmt::format("set {}range [{:.9g}:{:.9g}]\n", axis, lo, hi);
  if (const double width = hi - lo; most_ticks_ > 0 && width > 0 && std::isfinite(width))
    command += fmt::format("set {}tics {:.9g}\n", axis, step_of(width, most_ticks_, is_angle_));
  return command;
}

Axis axis_of(const SearchSubject& p, std::size_t variable, int most_ticks,
             const std::optional<Interval>& shown) {
  const VariableLabel& label = p.labels.variables[variable];
  return {p.variety.outer[variable], label.name, label.unit, most_ticks, shown};
}

std::string drawn_text(const VariableLabel& variable, const Interval& value) {
  const bool is_angle = variable.unit == "rad";
  const double factor = is_angle ? 180 / std::numbers::pi : 1;
  const std::string ends = short_interval({value.lo * factor, value.hi * factor});
  std::string text = fmt::format("{}{}", ends, unit_suffix(is_angle ? "deg" : variable.unit));
  for (std::size_t at; (at = text.find('-')) < ends.size();) text.replace(at, 1, "−");
  return fmt::format("{} {} {}", variable.name, ends.front() == '[' ? "in" : "=", text);
}

}  // namespace regulus::detail
