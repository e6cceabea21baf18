// SPDX-License-Identifier: Apache-2.0
// All postures of six joints that turn, for a place of the tool, counted: if 16 distinct simple ones
// are found among the complex ones, there is no other, neither complex nor real.
//
// Theorem (Primrose 1986; Lee & Liang 1988; Raghavan & Roth 1993): six axes in general position have
// 16 complex postures. SOUNDNESS.md derives from it that no arm has more than 16 simple ones, and that
// one which has 16 has no other.
//
// The arm and the tool are a loop of six joints. A joint turns by 2·arctan(u/v), which is v + uk; so
//
//     D = Π (v_i + u_i k) L_i  is 1 up to a factor  ⇔  the vectors of its two quaternions are 0,
//
// six equations in six points (u_i : v_i) with u_i² + v_i² ≠ 0.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "runtime/interval/interval.hpp"
#include "runtime/solutions/dual_quaternion.hpp"

namespace regulus::detail {

/// A rigid motion p ↦ Rp + t; rotation: row-major.
struct RigidMotion {
  std::array<Interval, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::array<Interval, 3> position{0, 0, 0};
};

/// A joint that turns about an axis through the origin of its frame.
struct TurningJoint {
  RigidMotion origin;              ///< of the joint's frame in that of the joint before
  std::array<Interval, 3> axis{};  ///< a unit vector
};

/// Enclosures of the numbers of six joints and of the frame after the last one. What is certain of
/// them is so for all rotations and unit vectors that are enclosed.
struct ArmToEnd {
  std::array<TurningJoint, 6> joints;
  RigidMotion end;  ///< in the frame before the first joint
};

using PostureAngles = std::array<Interval, 6>;  ///< angles in radians, about [−π, π]

inline constexpr std::size_t kPosturesOfArm = 16;

struct ArmPostures {
  std::vector<PostureAngles>
      postures;             ///< the real ones among those found, each certain and simple
  std::size_t complex = 0;  ///< distinct simple postures found, real ones included

  [[nodiscard]] bool is_complete() const noexcept { return complex == kPosturesOfArm; }
};

/// Ensures   each of `postures` encloses one real posture, and they are distinct. If is_complete(), the
///           arm has no other posture there, real or complex.
/// Rounding  outward; MXCSR at nearest. The result is the same in every run.
[[nodiscard]] ArmPostures find_arm_postures(const ArmToEnd& arm);

}  // namespace regulus::detail
