// SPDX-License-Identifier: Apache-2.0
// All poses of a Gough platform with given lengths of its legs, counted: if 40 distinct simple poses
// are found among the complex ones, there is no other pose at all, neither complex nor real.
//
// Theorem (Ronga & Vust 1995; Lazard 1993; Mourrain 1993): six legs in general position, between
// anchors a_i of the base and b_i of the platform, have 40 complex poses. SOUNDNESS.md derives from
// it that no platform has more than 40 simple ones, and that one which has 40 has no other. The same
// is shown there of 16 poses for legs that meet in three pairs, at the platform or at the base.
//
// A pose p ↦ Rp + t is a point (x : y) of the quadric x·y = 0, two quaternions up to a factor with
// x·x ≠ 0 (Study): R is the rotation of x, and t = yx̄/(x·x). A leg of length ρ between a and b means
//
//     w·w = ρ² x·x,   w = y + xb − ax      (Husty 1996, as a square).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "runtime/interval/interval.hpp"
#include "runtime/solutions/complex_root.hpp"

namespace regulus::detail {

/// Enclosures of the numbers of six legs. What is certain of them is so for all numbers enclosed.
struct GoughLegs {
  using Anchors = std::array<std::array<Interval, 3>, 6>;
  Anchors base;
  Anchors platform;
  std::array<Interval, 6> length;
  /// By leg: legs of the same number have this anchor in common, exactly.
  std::array<std::size_t, 6> base_point{0, 1, 2, 3, 4, 5};
  std::array<std::size_t, 6> platform_point{0, 1, 2, 3, 4, 5};
};

struct GoughPose {
  std::array<Interval, 4>
      rotation;  ///< unit quaternion w x y z; the first that is not about 0 is > 0
  std::array<Interval, 3> position;  ///< of the platform's origin

  friend bool operator==(const GoughPose&, const GoughPose&) = default;
};

inline constexpr std::size_t kPosesOfGough = 40;

/// The origin's position, and a quaternion up to a factor: roughly a complex pose.
using ApproxPose = std::array<Complex, 7>;

struct GoughPoses {
  std::vector<GoughPose> poses;      ///< the real ones among those found, each certain and simple
  std::vector<ApproxPose> approx{};  ///< all that were found
  std::size_t complex = 0;           ///< distinct simple poses found, real ones included
  std::size_t most = kPosesOfGough;  ///< no such platform has more simple poses

  [[nodiscard]] bool is_complete() const noexcept { return complex == most; }
};

/// Ensures   each of `poses` encloses one real pose, and they are distinct. If is_complete(), the
///           platform has no other pose, real or complex.
/// Rounding  outward; MXCSR at nearest. The result is the same in every run.
[[nodiscard]] GoughPoses find_gough_poses(const GoughLegs& legs);

/// Returns e such that the platform is about as large as 2ᵉ.
[[nodiscard]] int exponent_of_size(const GoughLegs& legs);

/// Encloses the rotation of a unit quaternion; row-major.
///
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] std::array<Interval, 9> rotation_matrix(const std::array<Interval, 4>& quaternion);

}  // namespace regulus::detail
