// SPDX-License-Identifier: GPL-3.0-or-later
// A serial arm in enclosures of its numbers.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "codegen/model/mechanism/serial.hpp"
#include "codegen/model/request.hpp"
#include "codegen/question/solve/vectors.hpp"

namespace regulus::detail {

using Vector3 = VectorOf<Interval>;
using Matrix3 = MatrixOf<Interval>;

// Rounding of these functions: outward; MXCSR at nearest.

/// Returns half of M − Mᵀ as a vector.
[[nodiscard]] Vector3 axial(const Matrix3& M) noexcept;
/// Returns [z]×A.
[[nodiscard]] Matrix3 across(const Vector3& z, const Matrix3& A) noexcept;

/// A rotation and a translation: x becomes Rx + d.
struct LinkFrame {
  Matrix3 R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  Vector3 d = {0, 0, 0};
};

[[nodiscard]] LinkFrame compose(const LinkFrame& first, const LinkFrame& second) noexcept;
[[nodiscard]] LinkFrame inverse(const LinkFrame& frame) noexcept;

/// The derivatives of a frame by each uncertain quantity; empty: they are not asked for.
using FrameRates = std::vector<LinkFrame>;
/// Returns those of compose(first, second). One of the two has none if it is constant.
[[nodiscard]] FrameRates rates_of_product(const LinkFrame& first, const FrameRates& of_first,
                                          const LinkFrame& second, const FrameRates& of_second);
[[nodiscard]] FrameRates rates_of_inverse(const LinkFrame& frame, const FrameRates& rates);

/// The value of a joint, and its derivatives by each uncertain quantity; none: it is constant.
struct ArmValue {
  Interval value;
  std::vector<Interval> rates = {};
};
[[nodiscard]] ArmValue operator*(const Interval& factor, const ArmValue& value);

/// A joint that turns about, or slides along, an axis through the origin of its frame.
struct ArmJoint {
  bool turns = true;
  LinkFrame origin;       ///< in the frame that the joint before moves
  Vector3 axis = {};      ///< a unit vector
  FrameRates rates = {};  ///< of the origin
  std::size_t unknown = 0;
  Interval factor = 1.0;  ///< the joint's value is so many times that of the unknown

  /// Encloses what the joint does.
  [[nodiscard]] LinkFrame moved(const Interval& value) const noexcept;
  /// Returns its derivatives.
  [[nodiscard]] FrameRates rates_of_moved(const ArmValue& value) const;
  [[nodiscard]] Interval value_at(std::span<const Interval> unknowns) const noexcept {
    return factor == Interval(1.0) ? unknowns[unknown] : factor * unknowns[unknown];
  }
};

using ArmChain = std::vector<ArmJoint>;

/// Which values the geometry of an arm has.
enum class ArmGeometry : std::uint8_t { kNominal, kWithinTolerances };

/// Encloses the arm, for all of these values. Offsets of joints that follow others are parts of their
/// origins.
///
/// `varying`: with derivatives by these symbols.
///
/// Throws    InputError if a number of it has no certain value.
[[nodiscard]] ArmChain enclose_chain(const Model& model, ArmGeometry geometry,
                                     const std::vector<GiNaC::realsymbol>& varying = {});

/// Encloses the value of each unknown (arm_unknowns.hpp), turns in radians. One without a value has 0: it
/// is free to bring the tool to its place. Errors of the place vary as those of `model`, which has the quantities of
/// request.model.
[[nodiscard]] std::vector<ArmValue> enclose_values(
    const Request& request, const Model& model, ArmGeometry geometry,
    const std::vector<GiNaC::realsymbol>& varying = {});

/// Encloses where these values bring the frame that the last joint moves, and its derivatives.
/// Errors of six joints widen it more than it moves, as each frame turns what the ones before have widened. The product of
/// their movements about the axes of the base, which are near 1, does not help the search: what it loses is in sums of
/// terms that cancel.
///
/// Requires  chain: without derivatives.
[[nodiscard]] std::pair<LinkFrame, FrameRates> end_of(const ArmChain& chain,
                                                      const std::vector<ArmValue>& values);

/// Encloses the frame of the last joint when the tool is at x, y, z, roll, pitch, yaw, and its derivatives.
[[nodiscard]] std::pair<LinkFrame, FrameRates> enclose_target(
    const Model& model, const std::vector<GiNaC::ex>& tool, ArmGeometry geometry,
    const std::vector<GiNaC::realsymbol>& varying = {});

/// The frame that the last joint moves, and each joint's axis and origin, all in the base.
struct ArmPosture {
  LinkFrame end;
  std::vector<Vector3> axes, origins;
};
[[nodiscard]] ArmPosture posture_at(const ArmChain& chain, std::span<const Interval> unknowns);

/// Returns the velocity that a joint of the chain gives to the end's origin.
[[nodiscard]] Vector3 velocity_by(const ArmChain& chain, const ArmPosture& posture,
                                  std::size_t joint);

/// Returns the forward Jacobian by the unknowns, row-major: the velocity of the end's origin, and its
/// angular velocity.
[[nodiscard]] std::vector<Interval> jacobian_at(const ArmChain& chain, const ArmPosture& posture,
                                                std::size_t unknowns);

}  // namespace regulus::detail
