// SPDX-License-Identifier: GPL-3.0-or-later
// The equations of an arm of six unknowns whose end is at a given frame.
#pragma once

#include "codegen/question/solve/arm_chain.hpp"
#include "codegen/question/solve/root_judge.hpp"

namespace regulus::detail {

/// As many joints as a frame has freedoms.
inline constexpr std::size_t kJoints = 6;

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

/// Σ k_ij·u_i·v_j with u = (1, cos a, sin a) and v = (1, cos b, sin b).
using Bilinear = std::array<std::array<Interval, 3>, 3>;

/// Four of six joints in a closed loop J₁B₁…J₆B₆ = I of movements J_i and fixed frames B_i. All turn, but
/// for the third, which may slide.
///
/// Seen from axis 3, the line of axis 6 is in the place P with direction L by the joints 1 and 2, and
/// in p, l by 4 and 5; rotations about axis 3 = k carry one to the other. So
///
///     k·P = k·p,   k·L = k·l,   |P|² = |p|²,   P·L = p·l,
///
/// four equations in q₁, q₂, q₄, q₅, each bilinear in the sines and cosines on either side; and
/// k·(P × L) = k·(p × l). All five together say that a rotation about k is there: q₃; the rest of the
/// orientation is q₆. If joint 3 slides, p becomes P along k, and l stays: with e, f across k,
///
///     e·P = e·p,   f·P = f·p,   e·L = e·l,   f·L = f·l,
///
/// bilinear, too, and k·L = k·l, because L and l are as long.
class OppositeAxes final : public RootSystem {
 public:
  /// Requires  six joints that turn, or all but the third.
  OppositeAxes(const ArmChain& chain, const LinkFrame& target);

  void evaluate(std::span<const Box> boxes, bool has_rates) override {
    boxes_.assign(boxes.begin(), boxes.end());
    has_rates_ = has_rates;
  }
  [[nodiscard]] std::optional<Values> at(std::size_t lane) const override;

  /// Returns the joints 3 and 6, approximately.
  [[nodiscard]] static std::array<double, 2> approx_others(const ArmChain& chain,
                                                           const LinkFrame& target,
                                                           std::span<const double> four);

 private:
  static constexpr std::size_t kEquations = 5;
  struct Equation {
    Bilinear left, right;  ///< left − right
  };
  std::array<Equation, kEquations> equations_;
  std::vector<Box> boxes_;
  bool has_rates_ = false;
};

/// Returns the chain that begins `first` joints later in the loop, and its target: its joint i is
/// joint (i + first) mod 6 of the given one, at the same values.
[[nodiscard]] std::pair<ArmChain, LinkFrame> rotated_loop(const ArmChain& chain,
                                                          const LinkFrame& target,
                                                          std::size_t first);

/// Moves the origin of each joint along its axis to where it is nearest to the axis before, and the
/// target with the last. The values of the joints stay.
void move_origins(ArmChain& chain, LinkFrame& target);

}  // namespace regulus::detail
