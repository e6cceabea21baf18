// SPDX-License-Identifier: Apache-2.0
// Chooses the variable to split.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "runtime/evaluation/batch.hpp"
#include "runtime/problem/problem.hpp"

namespace regulus::detail {

class Bisector {
 public:
  Bisector(const Problem& problem, const Settings& settings);

  /// Returns the variable in which to halve lane `lane` of the batch; nullopt if the box must not
  /// be split any more.
  [[nodiscard]] std::optional<std::size_t> choose(Batch& batch, std::size_t lane) const noexcept;

  /// Returns false if a box must not be split any more.
  [[nodiscard]] bool splits(std::span<const Interval> box) const noexcept;

  /// Returns how many variables have a range that can be split at all.
  [[nodiscard]] std::size_t variables_to_split() const noexcept;
  /// Returns the largest width of a box relative to the original ranges: the w(B) of Algorithm 1,
  /// whose parameters all range over [0, 1]. It orders the frontier and decides nothing.
  [[nodiscard]] double approx_relative_width(std::span<const Interval> box) const noexcept;

 private:
  [[nodiscard]] bool can_split(Interval x, std::size_t variable) const noexcept;
  [[nodiscard]] double approx_score(Batch& batch, std::size_t variable,
                                    std::size_t lane) const noexcept;

  Bisection bisection_;
  std::vector<double> weights_;  ///< of Settings
  std::size_t splittable_;       ///< the variables 0 … splittable_ − 1 may be split
  std::vector<double> range_;    ///< 0 for idle variables, which are not split
  std::vector<double> least_width_;
};

}  // namespace regulus::detail
