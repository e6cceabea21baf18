// SPDX-License-Identifier: Apache-2.0
// Views of arrays of eight lanes as matrices and vectors, of exact doubles or of intervals, in the
// layouts of runtime/interval/lanes.hpp. Each is a separate type: a matrix instead of a vector,
// bounds instead of points, or a constant instead of a result does not compile. A view does not own
// its numbers; it is passed in two registers.
#pragma once

#include <cstddef>
#include <type_traits>

#include "runtime/interval/lanes.hpp"

namespace regulus::detail {

enum class LaneLayout { kPoints, kIntervals };
enum class LaneShape { kVector, kMatrix };

/// A vector has one column; a matrix is row-major.
template <typename Double, LaneLayout kLayout, LaneShape kShape>
class LaneView {
 public:
  static constexpr bool kHasIntervals = kLayout == LaneLayout::kIntervals;
  static constexpr bool kIsMatrix = kShape == LaneShape::kMatrix;

  /// Requires  `numbers` are those of `size` entries.
  REGULUS_LANE_INLINE constexpr explicit LaneView(Double* numbers, std::size_t size) noexcept
      requires(!kIsMatrix)
      : numbers_(numbers), rows_(static_cast<unsigned>(size)), columns_(1) {}
  REGULUS_LANE_INLINE constexpr explicit LaneView(Double* numbers, std::size_t rows,
                                                  std::size_t columns) noexcept requires kIsMatrix
      : numbers_(numbers),
        rows_(static_cast<unsigned>(rows)),
        columns_(static_cast<unsigned>(columns)) {}
  /// Numbers that may be written may be read.
  REGULUS_LANE_INLINE constexpr operator LaneView<const Double, kLayout, kShape>() const noexcept
      requires(!std::is_const_v<Double>) {
    if constexpr (kIsMatrix)
      return LaneView<const Double, kLayout, kShape>(numbers_, rows_, columns_);
    else
      return LaneView<const Double, kLayout, kShape>(numbers_, rows_);
  }

  [[nodiscard]] REGULUS_LANE_INLINE constexpr Double* data() const noexcept { return numbers_; }
  [[nodiscard]] REGULUS_LANE_INLINE constexpr unsigned rows() const noexcept { return rows_; }
  [[nodiscard]] REGULUS_LANE_INLINE constexpr unsigned columns() const noexcept { return columns_; }
  [[nodiscard]] REGULUS_LANE_INLINE constexpr std::size_t size() const noexcept {
    return std::size_t{rows_} * columns_;
  }

  /// Returns entry e, row-major, of one lane.
  [[nodiscard]] REGULUS_LANE_INLINE constexpr Double& at(std::size_t e,
                                                         std::size_t lane) const noexcept
      requires(!kHasIntervals) {
    return numbers_[point_at(e, lane)];
  }
  [[nodiscard]] REGULUS_LANE_INLINE constexpr Double& lower(
      std::size_t e, std::size_t lane) const noexcept requires kHasIntervals {
    return numbers_[lower_at(e, lane)];
  }
  [[nodiscard]] REGULUS_LANE_INLINE constexpr Double& upper(
      std::size_t e, std::size_t lane) const noexcept requires kHasIntervals {
    return numbers_[upper_at(e, lane)];
  }

 private:
  Double* numbers_;
  unsigned rows_, columns_;
};

using PointVector = LaneView<double, LaneLayout::kPoints, LaneShape::kVector>;
using ConstPointVector = LaneView<const double, LaneLayout::kPoints, LaneShape::kVector>;
using PointMatrix = LaneView<double, LaneLayout::kPoints, LaneShape::kMatrix>;
using ConstPointMatrix = LaneView<const double, LaneLayout::kPoints, LaneShape::kMatrix>;
using IntervalVector = LaneView<double, LaneLayout::kIntervals, LaneShape::kVector>;
using ConstIntervalVector = LaneView<const double, LaneLayout::kIntervals, LaneShape::kVector>;
using IntervalMatrix = LaneView<double, LaneLayout::kIntervals, LaneShape::kMatrix>;
using ConstIntervalMatrix = LaneView<const double, LaneLayout::kIntervals, LaneShape::kMatrix>;

/// A number for each lane.
struct alignas(64) LaneNumbers {
  double of[kLanes];

  REGULUS_LANE_INLINE double& operator[](std::size_t lane) noexcept { return of[lane]; }
  REGULUS_LANE_INLINE double operator[](std::size_t lane) const noexcept { return of[lane]; }
};

/// The eigenvectors of a matrix: Pv = ρv, yᵀP = ρyᵀ.
struct PerronVectors {
  PointVector right, left;
};

/// An array in point layout; only its maker knows its size. It is a part of a workspace.
struct PointArray {
  double* x = nullptr;
};

}  // namespace regulus::detail
