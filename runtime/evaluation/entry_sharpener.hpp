// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "runtime/evaluation/matrix_evaluator.hpp"
#include "runtime/regularity/lanes.hpp"

namespace regulus::detail {

/// Narrows the entries of the method's matrix by their derivatives over the box: by the mean value
/// theorem, and by evaluating them on the faces where they are least and greatest. Faces are
/// collected and evaluated eight at a time. Entries of one trend share faces, and the lower face of
/// one trend is the upper face of the opposite trend.
class EntrySharpener {
 public:
  /// All must outlive this object.
  EntrySharpener(const BoxLanes& lanes, MidpointEvaluator& midpoint,
                 DerivativeEvaluator& derivatives, MatrixEvaluator& matrix);

  /// Requires  `entries` enclose those of the matrix, square, in `lanes`.
  /// Ensures   they still do; none is wider than before.
  void sharpen(IntervalMatrix entries, LaneMask lanes) noexcept;

 private:
  /// Variables from this number on count as not monotone.
  static constexpr std::size_t kMaxMonotone = 64;

  /// The variables with which an entry rises and falls, as bits; none if it is independent of one.
  struct Trend {
    std::uint64_t rising = 0;
    std::uint64_t falling = 0;

    [[nodiscard]] bool empty() const noexcept { return (rising | falling) == 0; }
    [[nodiscard]] Trend opposite() const noexcept { return {falling, rising}; }
    friend bool operator==(const Trend&, const Trend&) = default;
  };

  [[nodiscard]] IntervalMatrix found() noexcept;
  void intersect_with_mean_value(IntervalMatrix entries, LaneMask lanes) noexcept;
  void add_lane(IntervalMatrix entries, std::size_t lane) noexcept;
  [[nodiscard]] Trend trend_of(std::size_t e, std::size_t lane) const noexcept;
  [[nodiscard]] bool seen_before(std::size_t e, std::size_t lane) const noexcept;
  void add_face(IntervalMatrix entries, std::size_t lane, Trend trend) noexcept;
  void evaluate_faces(IntervalMatrix entries) noexcept;
  void fill_up() noexcept;

  const BoxLanes& lanes_;
  MidpointEvaluator& midpoint_;
  DerivativeEvaluator& derivatives_;
  MatrixEvaluator& matrix_;
  const std::size_t count_;  ///< entries
  AlignedBuffer face_boxes_, face_points_, entries_;
  std::size_t faces_ = 0;
  std::size_t face_lane_[kLanes];
  Trend face_trend_[kLanes];
  Trend trend_[kLanes][kMaxColumns * kMaxColumns];
};

}  // namespace regulus::detail
