// SPDX-License-Identifier: GPL-3.0-or-later
// The results of the suite, before any report is written.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/measure/machine.hpp"
#include "tests/bench/measure/rounds.hpp"

namespace regulus::detail::bench {

/// The target of a row, for its value or for its ratio.
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
  std::string skipped;      ///< why there is no value; empty if there is a value
};

/// Returns nullopt if there is no target, or no figure for it.
[[nodiscard]] std::optional<bool> met(const Row& row);

struct Section {
  std::string name;  ///< for the option --only, and in the JSON
  std::string title;
  std::string note;  ///< facts common to the rows, and the reference of the ratio
  std::vector<Row> rows;
};

struct Report {
  Machine machine;
  std::vector<Section> sections;
};

/// Returns a row with the median time of a unit in `unit`, 1/`scale` seconds each, and its ratio.
[[nodiscard]] Row timed_row(std::string name, const Timing& timing, double scale, std::string unit,
                            std::string explanation);

/// Returns a row that could not be measured.
[[nodiscard]] Row skipped_row(std::string name, std::string reason, std::string explanation);

}  // namespace regulus::detail::bench
