// SPDX-License-Identifier: GPL-3.0-or-later
// What the suite found out, before it is written down anywhere.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/measure/machine.hpp"
#include "tests/bench/measure/rounds.hpp"

namespace regulus::bench {

/// What a row should show, of its value or of its ratio.
struct Target {
  enum class Of { kValue, kRatio } of;
  enum class Sense { kAtLeast, kAtMost } sense;
  double bound;
};

[[nodiscard]] constexpr Target ratio_at_least(double bound) {
  return {Target::Of::kRatio, Target::Sense::kAtLeast, bound};
}
[[nodiscard]] constexpr Target ratio_at_most(double bound) {
  return {Target::Of::kRatio, Target::Sense::kAtMost, bound};
}
[[nodiscard]] constexpr Target value_at_least(double bound) {
  return {Target::Of::kValue, Target::Sense::kAtLeast, bound};
}
[[nodiscard]] constexpr Target value_at_most(double bound) {
  return {Target::Of::kValue, Target::Sense::kAtMost, bound};
}

struct Row {
  std::string name;
  std::optional<double> value;
  std::string unit;
  std::optional<Spread> ratio;  ///< to the section's reference
  std::optional<Target> target;
  std::string explanation;  ///< one line
  std::string skipped;      ///< why there is no value; empty if there is one
};

/// nullopt without a target, or without the figure it is about.
[[nodiscard]] std::optional<bool> met(const Row& row);

struct Section {
  std::string name;  ///< of the option --only, and in the JSON
  std::string title;
  std::string note;  ///< what the rows have in common, and what the ratio is to
  std::vector<Row> rows;
};

struct Report {
  Machine machine;
  std::vector<Section> sections;
};

/// The median time of a unit in `unit`, `scale` of which are a second, and its ratio.
[[nodiscard]] Row timed_row(std::string name, const Timing& timing, double scale, std::string unit,
                            std::string explanation);

/// A row that could not be measured.
[[nodiscard]] Row skipped_row(std::string name, std::string reason, std::string explanation);

}  // namespace regulus::bench
