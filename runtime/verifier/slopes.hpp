// SPDX-License-Identifier: Apache-2.0
// The matrix at the middle of a box, and its derivatives over the box.
#pragma once

#include "runtime/verifier/outside.hpp"

namespace regulus::verifier {

/// A(x) ∈ A(c) + Σ_k [−1, 1]·∂_kA·r_k at every point x of a box with the middle c, entry by entry.
class MatrixSlopes {
 public:
  /// Adds derivatives to the question's graph.
  explicit MatrixSlopes(Question& question);

  /// The derivative of an entry by a variable, where it is not 0 everywhere.
  struct Slope {
    std::size_t row, column;
    NodeId node;
  };
  struct SlopesOf {
    std::size_t variable;
    std::vector<Slope> entries;
  };

  /// Returns false if the model is not certainly defined all over the box, or if a number is too
  /// large. If a derivative is not bounded, entry() encloses A over the box, and of() is empty.
  [[nodiscard]] bool run(const Box& box, const Middle& middle);

  /// Encloses an entry of A(c).
  [[nodiscard]] Interval entry(std::size_t row, std::size_t column) const {
    return A_[row * q_.columns + column];
  }
  [[nodiscard]] const std::vector<Interval>& entries() const noexcept { return A_; }
  /// The derivatives by each variable that A depends on.
  [[nodiscard]] const std::vector<SlopesOf>& of() const noexcept {
    return has_slopes_ ? slopes_ : none_;
  }
  /// Encloses derivative e of of()[s] over the box.
  [[nodiscard]] Interval slope(std::size_t s, std::size_t e) const { return dA_[s][e]; }
  /// r of the variable of of()[s], rounded upward.
  [[nodiscard]] double radius(std::size_t s) const { return radius_[s]; }

 private:
  const Question& q_;
  Evaluation defined_;
  std::vector<SlopesOf> slopes_;
  const std::vector<SlopesOf> none_;
  std::optional<Evaluation> at_middle_, over_box_;

  // For one box.
  bool has_slopes_ = false;
  std::vector<Interval> A_;
  std::vector<std::vector<Interval>> dA_;
  std::vector<double> radius_;
};

/// Returns true if all are within the limit of rounding.hpp.
[[nodiscard]] bool is_moderate(const std::vector<Interval>& values);

}  // namespace regulus::verifier
