// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "runtime/problem/result.hpp"

namespace regulus {

/// Reports that a search makes no progress: a long run of boxes closed so little of the variety
/// that all of it would take 2^40 boxes.
///
/// Boxes of many variables are small parts of the variety, even if they are certified quickly. They
/// are not reported unless most of them needed more digits than doubles have, or they are as small
/// as boxes with sides of 2^-24 of the ranges. A box that needs more digits takes the time of many
/// others and counts as so many. So a run of them is no longer than a run of
/// the others.
class Headway {
 public:
  /// The run so far.
  struct Run {
    std::uint64_t begin = 0;  ///< boxes evaluated before it
    std::uint64_t leaves = 0, multiprecision = 0;
    double part = 0;  ///< of the variety; a box after d splits is 2^-d of it
  };

  Headway() = default;
  explicit Headway(const Run& run) noexcept : run_(run) {}
  [[nodiscard]] const Run& run() const noexcept { return run_; }

  /// Begins a run at that number of boxes.
  void begin(std::uint64_t boxes) noexcept {
    run_ = {};
    run_.begin = boxes;
  }

  /// Counts a leaf after that number of splits.
  void close(std::uint32_t depth, Rule rule) noexcept {
    run_.part += std::ldexp(1.0, -static_cast<int>(std::min(depth, 1000U)));
    ++run_.leaves;
    if (rule == Rule::kMultiprecision) ++run_.multiprecision;
  }

  /// Returns true if a run ended at this number of boxes and closed next to nothing. Begins a run.
  [[nodiscard]] bool stalls(std::uint64_t boxes, std::size_t variables_to_split) noexcept {
    if (boxes - run_.begin + kMultiprecisionBoxes * run_.multiprecision < kBoxesOfRun) return false;
    const bool few = variables_to_split <= kFewVariables || 2 * run_.multiprecision > run_.leaves;
    const bool stalled = run_.part < (few ? kLeastPart : least_part_of_many(variables_to_split));
    begin(boxes);
    return stalled;
  }

 private:
  /// Returns the least part of a run of boxes of that size.
  static double least_part_of_many(std::size_t variables) noexcept {
    const std::size_t halvings = std::min<std::size_t>(kHalvingsOfSide * variables, 1000);
    return std::ldexp(static_cast<double>(kBoxesOfRun), -static_cast<int>(halvings));
  }

  static constexpr std::uint64_t kBoxesOfRun = 1U << 20;
  static constexpr double kLeastPart = 0x1p-20;
  static constexpr std::size_t kFewVariables = 3;
  static constexpr std::size_t kHalvingsOfSide = 24;
  static constexpr std::uint64_t kMultiprecisionBoxes = 16;

  Run run_;
};

}  // namespace regulus
