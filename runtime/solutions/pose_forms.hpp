// SPDX-License-Identifier: Apache-2.0
// The numbers of PoseEquations for code of eight lanes: plain arrays, because files for different
// instruction sets must share no inline function.
#pragma once

namespace regulus::detail {

inline constexpr int kMostFreeNumbers = 6;
inline constexpr int kMostPoseUnknowns = 3 + kMostFreeNumbers;
/// The number of further expressions that are 0 at a pose.
inline constexpr int kPoseExtras = 10;

/// constant + Σ by_rotation·R + Σ by_free·(free numbers); each coefficient is an interval {lo, hi}.
struct PoseForm {
  double constant[2];
  double by_rotation[9][2];  ///< of R, row-major
  double by_free[kMostFreeNumbers][2];
};

struct PoseForms {
  int free;                         ///< how many numbers are unknowns
  PoseForm number[7];               ///< r, s, t
  PoseForm left[kMostFreeNumbers];  ///< free − 1 forms that are 0
  double reach;                     ///< no part of s or t is larger at a pose
};

/// The first rows of the values of eight boxes: values, derivatives (by equation), what else is 0, and
/// the derivatives of the derivatives (by unknown, then as those).
struct PoseRows {
  int unknowns;

  [[nodiscard]] constexpr int derivatives() const { return unknowns; }
  [[nodiscard]] constexpr int extras() const { return unknowns + unknowns * unknowns; }
  [[nodiscard]] constexpr int rates() const { return extras() + kPoseExtras; }
  [[nodiscard]] constexpr int all() const { return rates() + unknowns * unknowns * unknowns; }
};

}  // namespace regulus::detail
