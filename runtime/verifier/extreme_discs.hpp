// SPDX-License-Identifier: Apache-2.0
// Bounds of the largest and the least singular value of an almost diagonal matrix over a box, which
// both change with its point.
#pragma once

#include "runtime/verifier/rotated_terms.hpp"

namespace regulus::verifier {

/// A claim about singular values and a number T.
enum class SingularClaim {
  kRatioBelow,    ///< σ_max < T·σ_min
  kLargestBelow,  ///< σ_max < T
  kLeastAbove,    ///< σ_min > T
};

class ExtremeDiscs {
 public:
  /// `B` must outlive this object; its numbers are moderate. `bound`: T, positive.
  ExtremeDiscs(const RotatedMatrix& B, std::size_t rows, std::size_t columns, SingularClaim claim,
               double bound);

  /// Returns true only if the claim holds all over the box.
  [[nodiscard]] bool keep_claim();

  /// After keep_claim(): roughly what each variable adds to the bounds by errors of second order.
  [[nodiscard]] std::vector<double> parts() const;

 private:
  using Doubles = std::vector<double>;

  /// Positive vectors: of the rows and of the columns.
  struct Weights {
    Doubles z, y;
  };
  /// A bound alpha·b_i ± beta of an extreme value, b_i = B_ii.
  struct Disc {
    std::size_t i;
    Interval alpha;
    double beta;
  };

  [[nodiscard]] double off(std::size_t i, std::size_t j) const {
    return i == j ? 0.0 : off_[i * n_ + j];
  }
  void bound_entries();
  [[nodiscard]] bool are_apart();
  [[nodiscard]] bool are_below();
  [[nodiscard]] bool are_above();
  [[nodiscard]] double least(std::size_t i) const;
  [[nodiscard]] double slack(std::size_t i, std::size_t l) const;
  [[nodiscard]] Weights find_weights(bool of_largest) const;
  [[nodiscard]] std::vector<Disc> discs(const Weights& weights, std::size_t rows) const;
  [[nodiscard]] Interval term(const Disc& disc, const std::vector<Interval>& matrix) const {
    return disc.i < n_ ? disc.alpha * matrix[disc.i * n_ + disc.i] : Interval{};
  }
  [[nodiscard]] bool is_positive(const Disc& low) const;
  [[nodiscard]] bool is_apart(const Disc& high, const Disc& low) const;

  const RotatedMatrix& B_;
  const std::size_t m_, n_;
  const SingularClaim claim_;
  const double T_;
  Doubles off_;  ///< bounds of |B_ij| over the box
  Doubles high_slack_, low_slack_;
  Weights high_, low_;
};

}  // namespace regulus::verifier
