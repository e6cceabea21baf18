// SPDX-License-Identifier: GPL-3.0-or-later
// The equations of an arm of six unknowns whose end is at a given frame.
#pragma once

#include "codegen/question/solve/arm_chain.hpp"
#include "codegen/question/solve/root_judge.hpp"

namespace regulus::detail {

/// As many joints as a frame has freedoms.
inline constexpr std::size_t kJoints = 6;
/// As many as the freedoms of a frame that turns about one direction.
inline constexpr std::size_t kFourJoints = 4;

/// All unknowns: the end's origin is at that of the frame, and E = R(q)·R*ᵀ has no axial vector.
/// Then E is the unit matrix or a half turn; at the first the derivatives are regular exactly where the
/// forward Jacobian is. Its trace tells them apart.
///
/// With z_k the axes, v_k the velocities of the end's origin, and j ≤ k, the second derivatives by joints that turn
/// are z_j × v_k and the axial vector of [z_j]×[z_k]×E: what is behind joint j turns with it, as one body. An unknown
/// that moves several joints has the sum of their columns, each times its factor.
class WholeArm final : public RootSystem {
 public:
  /// `has_rates`: with second derivatives, where they are asked for.
  WholeArm(const ArmChain& chain, const LinkFrame& target, bool has_rates = false)
      : chain_(chain), target_(target), has_rates_(has_rates) {}

  void evaluate(std::span<const Box> boxes, bool are_rates_needed) override {
    boxes_.assign(boxes.begin(), boxes.end());
    are_rates_needed_ = are_rates_needed;
  }
  /// `also`: 3 less the trace of E.
  [[nodiscard]] std::optional<Values> at(std::size_t lane) const override;

 private:
  void add_rates(Values& values, std::size_t n, const ArmPosture& posture, const Matrix3& E) const;

  const ArmChain& chain_;
  const LinkFrame& target_;
  const bool has_rates_;
  std::vector<Box> boxes_;
  bool are_rates_needed_ = false;
};

/// An arm that turns about one direction n alone, with four unknowns. E is a rotation about n, so the equations are those
/// of the origin and n·e = 0 for the axial vector e of E.
class ArmAboutDirection final : public RootSystem {
 public:
  ArmAboutDirection(const ArmChain& chain, const LinkFrame& target, const Vector3& direction)
      : whole_(chain, target, true), direction_(direction) {}

  void evaluate(std::span<const Box> boxes, bool are_rates_needed) override {
    whole_.evaluate(boxes, are_rates_needed);
  }
  /// `also`: 3 less the trace of E.
  [[nodiscard]] std::optional<Values> at(std::size_t lane) const override;

 private:
  WholeArm whole_;
  const Vector3 direction_;
};

/// Joins the last three of six rows of numbers to one: n·(their columns).
[[nodiscard]] std::vector<Interval> along(const Vector3& n, const std::vector<Interval>& rows);

/// The joints and the end of an arm.
struct ArmLoop {
  ArmChain chain;
  LinkFrame target;
  FrameRates target_rates = {};  ///< as those of the joints
};

/// An arm within tolerances, and what it is without them.
struct VaryingLoop {
  ArmLoop within;                      ///< with rates by each deviation
  ArmLoop nominal;                     ///< with the same joints; empty: there are no deviations
  std::vector<Interval> deviations{};  ///< all of them are 0 in the nominal one
};

/// Returns the arm that begins `first` joints later in the loop: its joint i is joint (i + first) mod 6 of the given
/// one, at the same values.
[[nodiscard]] ArmLoop rotated_loop(const ArmLoop& arm, std::size_t first);

/// Moves the origin of each joint along its axis to where it is nearest to the axis before, and the
/// target with the last. The values of the joints stay.
///
/// `alike`: gets the same shifts; may be null.
void move_origins(ArmLoop& arm, ArmLoop* alike);

}  // namespace regulus::detail
