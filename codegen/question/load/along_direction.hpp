// SPDX-License-Identifier: GPL-3.0-or-later
// A load needs so much along a direction, and forces within the limits give at most so much: NOT HELD and
// FREE of force_test.hpp.
#pragma once

#include <vector>

#include "codegen/question/engine/box_matrices.hpp"
#include "codegen/question/load/force_problem.hpp"

namespace regulus::detail {

/// A direction at each pose of a box, or at its point c: along it no free force has power.
class AlongDirection {
 public:
  /// `near`: the direction is near it. `weight`, `scaled_inverse`: of the rows, and K in their units,
  /// n×m, row-major; nothing is supposed of them.
  AlongDirection(const ForceProblem& problem, const BoxMatrix& box,
                 const std::vector<double>& weight, const std::vector<double>& scaled_inverse,
                 const std::vector<double>& near, bool over_box);

  /// False: no such direction was found, and the others must not be called.
  [[nodiscard]] bool is_found() const noexcept { return is_found_; }

  /// Encloses what the load at a corner needs, with the vectors of the balls that need most.
  [[nodiscard]] Interval needed(std::size_t corner) const;

  /// Encloses the most that forces within the limits give.
  [[nodiscard]] Interval possible() const;

 private:
  [[nodiscard]] const Interval& slope(std::size_t k, std::size_t i, std::size_t j) const {
    return box_.slopes[(k * m_ + i) * n_ + j];
  }
  [[nodiscard]] Interval entry(std::size_t i, std::size_t j) const;
  [[nodiscard]] Interval along(std::size_t i) const;
  [[nodiscard]] Interval bound_of_steps(const std::vector<double>& weight,
                                        const std::vector<double>& scaled_inverse) const;

  const ForceProblem& problem_;
  const BoxMatrix& box_;
  const std::size_t m_, n_;
  const std::size_t parameters_;  ///< that vary; 0: at c
  std::vector<Interval> y_;
  bool is_found_ = true;
};

}  // namespace regulus::detail
