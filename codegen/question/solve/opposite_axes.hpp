// SPDX-License-Identifier: GPL-3.0-or-later
// The equations of six joints in four of them.
#pragma once

#include "codegen/question/solve/arm_system.hpp"
#include "codegen/question/solve/left_out_pair.hpp"

namespace regulus::detail {

/// Σ k_ij·u_i·v_j with u = (1, cos a, sin a) and v = (1, cos b, sin b).
template <class T>
using BilinearOf = std::array<std::array<T, 3>, 3>;
using Bilinear = BilinearOf<Interval>;

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
///
/// If the arm varies, the equations have rates by the deviations, too.
class OppositeEquations {
 public:
  static constexpr std::size_t kAll = 5;
  struct Equation {
    Bilinear left, right;  ///< left − right
  };
  using Equations = std::array<Equation, kAll>;

  /// Requires  six joints that turn, or all but the third.
  explicit OppositeEquations(const VaryingLoop& arm);

  Equations within, nominal;
  std::vector<Equations> rates;  ///< by deviation, within the tolerances
  std::vector<Interval> deviations;
};

class OppositeAxes final : public RootSystem {
 public:
  explicit OppositeAxes(std::shared_ptr<const OppositeEquations> equations)
      : equations_(std::move(equations)) {}

  void evaluate(std::span<const Box> boxes, bool has_rates) override {
    boxes_.assign(boxes.begin(), boxes.end());
    has_rates_ = has_rates;
  }
  [[nodiscard]] std::optional<Values> at(std::size_t lane) const override;

 private:
  const std::shared_ptr<const OppositeEquations> equations_;
  std::vector<Box> boxes_;
  bool has_rates_ = false;
};

/// Returns the joints 3 and 6, with what values of the others make of the loop.
[[nodiscard]] PairInLoop opposite_pair(const ArmLoop& arm, std::span<const Interval> four);

}  // namespace regulus::detail
