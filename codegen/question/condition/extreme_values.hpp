// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds of the largest and the least singular value of a matrix that is nearly diagonal.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace regulus::detail {

/// One of the bounds α·b_i ± β of condition_test.hpp.
struct Disc {
  std::size_t index;  ///< i
  double alpha;       ///< to nearest
  double beta;        ///< rounded up
};

/// Values that the b_i may attain, roughly; they choose y and z.
struct Reach {
  std::vector<double> farthest;  ///< over the box
  std::vector<double> goal;      ///< the disc of the most extreme one should reach that far
};

class ExtremeValues {
 public:
  /// `off`: o_ij, rows × columns, 0 on the diagonal; it must outlive this object.
  ExtremeValues(const std::vector<double>& off, std::size_t rows, std::size_t columns,
                const Reach& high, const Reach& low);

  /// σ_max ≤ max (α·b_i + β).
  [[nodiscard]] const std::vector<Disc>& highest() const noexcept { return highest_; }
  /// σ_min ≥ min (α·b_i − β), if that is positive.
  [[nodiscard]] const std::vector<Disc>& lowest() const noexcept { return lowest_; }

  /// Returns roughly how much `part` of o_ij adds to each of the two extreme values.
  [[nodiscard]] std::pair<double, double> shares(const std::vector<double>& part) const;

 private:
  /// Positive vectors y of n and z of m components.
  struct Weights {
    std::vector<double> y, z;
  };

  [[nodiscard]] Weights choose(const Reach& reach, std::size_t pivot, bool largest) const;
  void balance(Weights& w, const Reach& reach, std::size_t pivot, bool largest) const;
  [[nodiscard]] double along_row(std::size_t i, const std::vector<double>& y) const;
  [[nodiscard]] double along_column(std::size_t j, const std::vector<double>& z,
                                    std::size_t rows) const;
  [[nodiscard]] Disc row(std::size_t i, const Weights& w) const;
  [[nodiscard]] Disc column(std::size_t j, const Weights& w, std::size_t rows) const;
  [[nodiscard]] double share(const std::vector<double>& part, std::size_t pivot, const Weights& w,
                             std::size_t rows) const;

  const std::vector<double>& off_;
  const std::size_t m_, n_;
  std::size_t top_ = 0, low_ = 0;
  Weights top_weights_, low_weights_;
  std::vector<Disc> highest_, lowest_;
};

}  // namespace regulus::detail
