// SPDX-License-Identifier: Apache-2.0
// The equations of six legs in six unknowns near a pose.
//
// Seen from a pose (R, t) with R(b) + t = a′ for anchors b, and a of the base, another one near it has the
// rotation R·C(v) of the quaternion 1 + v, and the position t + Ru. With c = Rᵀ(a − t) and n = 1 + v·v its
// leg from a to b has the length ρ if
//
//     n(|u − c|² + b·b − ρ²) + 2(u − c)·Q(v)b = 0,   Q(v)b = (1 − v·v)b + 2(v·b)v + 2v × b.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "runtime/solutions/gough_poses.hpp"

namespace regulus::detail {

/// The legs as a pose sees them. Rounding of its functions: outward; MXCSR at nearest.
class LegsNearPose {
 public:
  /// `pose`: any numbers; its rotation is taken as that of the quaternion, which need not be a unit.
  ///
  /// Requires  a rotation that is not 0.
  LegsNearPose(const GoughLegs& legs, const std::array<double, 4>& rotation,
               const std::array<double, 3>& position);

  static constexpr std::size_t kUnknowns = 6;  ///< u, then v
  using Unknowns = std::array<Interval, kUnknowns>;
  struct Values {
    std::array<Interval, kUnknowns> value;
    std::array<Interval, kUnknowns * kUnknowns> by_unknown;  ///< row-major: by leg
  };

  [[nodiscard]] Values at(const Unknowns& unknowns) const;

  /// By leg, the second derivatives: twice n by each part of u; by u_j and v_k; by v_j and v_k.
  struct Bends {
    Interval by_u;
    std::array<std::array<Interval, 9>, kUnknowns> by_u_and_v;  ///< row-major: by j
    std::array<std::array<Interval, 9>, kUnknowns> by_v;        ///< symmetric
  };
  [[nodiscard]] Bends bends(const Unknowns& unknowns) const;

  /// Encloses the unknowns of poses whose rotation is not a half turn from here; nullopt: one may be.
  [[nodiscard]] std::optional<Unknowns> unknowns_of(const GoughPose& pose) const;
  [[nodiscard]] GoughPose pose_of(const Unknowns& unknowns) const;

 private:
  std::array<Interval, 4> rotation_;  ///< encloses a unit quaternion
  std::array<Interval, 9> matrix_;
  std::array<Interval, 3> position_;
  std::array<std::array<Interval, 3>, 6> base_, platform_;
  std::array<Interval, 6> square_;  ///< b·b − ρ²
};

struct NarrowedPoses {
  std::optional<GoughPose> poses;  ///< nullopt: there are none
  bool is_regular = false;         ///< the derivatives are, all over `poses`, for all of the legs
};

/// Narrows an enclosure of poses of some of the legs, as far as the mean-value form of the equations does.
///
/// Ensures   every pose of any of the legs in `poses` is in the result.
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] NarrowedPoses narrow_poses(const GoughLegs& legs, const GoughPose& poses);

}  // namespace regulus::detail
