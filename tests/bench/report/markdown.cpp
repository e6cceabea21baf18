// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cmath>

#include "tests/bench/report/writers.hpp"

namespace regulus::detail::bench {
namespace {

/// Prints three digits without an exponent: 0.0123, 1.23, 123, 12300. Counts of up to five digits
/// are printed in full.
std::string digits(double x) {
  if (x == 0) return "0";
  constexpr int kDigits = 3;
  const int before = static_cast<int>(std::floor(std::log10(std::fabs(x)))) + 1;
  constexpr double kCounts = 1e5;
  if (before > kDigits && x == std::trunc(x) && x < kCounts) return fmt::format("{:.0f}", x);
  const double unit = std::pow(10.0, before - kDigits);
  return fmt::format("{:.{}f}", std::round(x / unit) * unit, std::max(0, kDigits - before));
}

std::string words(const Target& target) {
  return fmt::format("{} {} {}", target.of == Target::Of::kRatio ? "ratio" : "value",
                     target.sense == Target::Sense::kAtLeast ? "≥" : "≤", digits(target.bound));
}

std::string words(const std::optional<Spread>& ratio) {
  if (!ratio) return "";
  if (ratio->low == ratio->high) return digits(ratio->median);
  return fmt::format("{} ({}–{})", digits(ratio->median), digits(ratio->low), digits(ratio->high));
}

std::string line(const Row& row) {
  const std::string value = row.value ? fmt::format("{} {}", digits(*row.value), row.unit)
                                      : fmt::format("skipped: {}", row.skipped);
  const std::optional<bool> reached = met(row);
  return fmt::format("| {} | {} | {} | {} | {} | {} |\n", row.name, value, words(row.ratio),
                     row.target ? words(*row.target) : "",
                     reached ? (*reached ? "yes" : "**no**") : "", row.explanation);
}

}  // namespace

std::string to_markdown(const Section& section) {
  std::string text = fmt::format(
      "## {}\n\n{}\n\n| | value | ratio | target | met | what it is |\n|---|---|---|---|---|---|\n",
      section.title, section.note);
  for (const Row& row : section.rows) text += line(row);
  return text;
}

std::string to_markdown(const Report& report) {
  const Machine& m = report.machine;
  std::string text = fmt::format(
      "# What it costs\n\nWritten by `make bench`. {}, {} processors, which {:.2g} other programs "
      "wanted at the time;\ncompiled by {}, in process by {}.\n\nThe machine is shared and its "
      "clock "
      "rate moves. So everything is timed in interleaved rounds, beside\nthe reference of its "
      "table; "
      "a ratio is the median over the rounds of the ratio within a round, the\nquartiles behind "
      "it. A "
      "value is the median of its own times, and depends on the hour.\n\n{}.\n",
      m.processor, m.processors, m.load, m.compiler, m.in_process, summary(report));
  for (const Section& section : report.sections) text += fmt::format("\n{}", to_markdown(section));
  return text;
}

std::string summary(const Report& report) {
  int targets = 0, reached = 0;
  for (const Section& section : report.sections)
    for (const Row& row : section.rows) {
      const std::optional<bool> result = met(row);
      targets += result.has_value();
      reached += result.value_or(false);
    }
  return fmt::format("{} of {} targets met", reached, targets);
}

}  // namespace regulus::detail::bench
