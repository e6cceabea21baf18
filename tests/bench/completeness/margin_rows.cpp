// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cstdio>

#include "codegen/use/api/margin.hpp"
#include "tests/bench/completeness/rows.hpp"

namespace regulus::detail::bench {
namespace {

constexpr double kSeconds = 20;

/// Returns how close the largest proved tolerance comes to the least one with a singularity.
Row margin_row(const char* model, const char* motion, const char* range, double least) {
  Row row;
  row.name = fmt::format("{} {}", model, motion);
  row.unit = std::string("%");
  row.target = value_at_least(least);
  const Question question =
      Question::of_file(fmt::format("{}/models/{}.toml", REGULUS_SOURCE_DIR, model), motion);
  MarginOptions options;
  options.tolerance = fmt::format("base,platform={}", range);
  options.gap = "0.001";
  options.search.threads = 1;
  options.search.time_limit = kSeconds;
  const MarginFinding finding = margin(question, options);
  double safe = 0.0, singular = 0.0;
  const std::size_t second = finding.bracket.find("NOT AT ");
  if (second == std::string::npos ||
      std::sscanf(finding.bracket.c_str(), "SAFE UP TO %lf", &safe) != 1 ||
      std::sscanf(finding.bracket.c_str() + second, "NOT AT %lf", &singular) != 1) {
    row.skipped = finding.bracket;
    return row;
  }
  row.value = 100.0 * safe / singular;
  row.explanation = finding.bracket;
  return row;
}

}  // namespace

Section margin_rows() {
  return {"margins",
          "How close a proof comes to a singularity",
          fmt::format("`regulus margin --tolerance base,platform=LO:HI` with one thread, within {} "
                      "s: the largest proved tolerance, of the least one with a singularity.",
                      kSeconds),
          {margin_row("robot_1", "wide_15", "0.1:0.2", 99.5),
           margin_row("robot_1", "table4_5", "0.1:0.3", 99)}};
}

}  // namespace regulus::detail::bench
