// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/number_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>

namespace regulus::detail {

std::string shortest_text(double x) { return fmt::format("{}", x + 0.0); }  // −0 reads as 0

std::string shortest_text_in(const Interval& x) {
  const bool negative = x.hi <= 0;
  for (int digits = 1; digits < 17; ++digits)
    for (const double end : {negative ? x.hi : x.lo, negative ? x.lo : x.hi}) {
      const std::string text = fmt::format("{:.{}g}", end, digits);
      double shown = 0;
      std::from_chars(text.data(), text.data() + text.size(), shown);
      if (x.lo <= shown && shown <= x.hi) return shortest_text(shown);
    }
  return shortest_text(negative ? x.hi : x.lo);
}

std::string ends_text(const std::string& lo, const std::string& hi) {
  return lo == hi ? lo : fmt::format("[{}, {}]", lo, hi);
}

nlohmann::ordered_json json_interval(const Interval& x) {
  const auto without_sign = [](double end) { return end == 0 ? 0.0 : end; };  // of −0
  return nlohmann::ordered_json::array({without_sign(x.lo), without_sign(x.hi)});
}

std::string counted(std::uint64_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string in_thousands(std::uint64_t count) {
  if (count < 1000) return std::to_string(count);
  return fmt::format("{} {:03}", in_thousands(count / 1000), count % 1000);
}

std::string short_interval(const Interval& x) {
  const std::string lo = fmt::format("{:.6g}", x.lo + 0.0);  // −0 reads as 0
  const std::string hi = fmt::format("{:.6g}", x.hi + 0.0);
  return lo == hi ? lo : fmt::format("[{}, {}]", lo, hi);
}

std::string threshold_text(const Interval& alpha, bool exceeded) {
  const double end = exceeded ? alpha.lo : alpha.hi;
  for (int digits = 6;; ++digits) {
    const std::string text = fmt::format("{:.{}g}", end, digits);
    double shown = 0;
    std::from_chars(text.data(), text.data() + text.size(), shown);
    if ((alpha.lo <= shown && shown <= alpha.hi) || digits == 17) return text;
  }
}

std::string unit_suffix(const std::string& unit) {
  return unit.empty() || unit == "1" ? "" : " " + unit;
}

std::string value_text(const Interval& x) {
  const std::string brief = short_interval(x);
  return brief.front() == '[' ? ends_text(shortest_text(x.lo), shortest_text(x.hi))
                              : shortest_text_in(x);
}

}  // namespace regulus::detail
