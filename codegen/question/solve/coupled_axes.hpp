// SPDX-License-Identifier: GPL-3.0-or-later
// The equations of an arm of six unknowns, some of which move several joints, in four of them.
#pragma once

#include <memory>

#include "codegen/question/solve/arm_system.hpp"
#include "codegen/question/solve/left_out_pair.hpp"
#include "codegen/question/solve/trig_form.hpp"

namespace regulus::detail {

/// The joints of the chain whose unknowns are left out, and the other unknowns: four or fewer.
struct CoupledChoice {
  std::size_t a = 0, b = 0;
  std::vector<std::size_t> searched{};
};

/// Two unknowns that move one joint each, a and b, in a closed loop J₁B₁…J_nB_n = I. Joint b turns, joint a turns
/// or slides.
///
/// Seen from axis a, the line of axis b is in the place P with direction L by the joints between a and b, and in p, l
/// by those from b around the loop to a. A movement about or along axis a carries one to the other, so the five
/// equations of OppositeAxes hold, in the other four unknowns, wherever their joints are. The numbers
///
///     P, |P|², L, P·L, P × L
///
/// of a line are linear in those of the same line that is turned and moved: both sides are built from the inside out,
/// and are sums of products of the unknowns and of sines and cosines of their multiples. Where a follower turns an
/// orientation back, the coefficients of the double angles are 0 but for rounding.
///
/// Returns the five equations.
///
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] TrigForms coupled_equations(const ArmChain& chain, const LinkFrame& target,
                                          const CoupledChoice& choice);

/// Returns how many terms they have: fewer where the joints between a and b are as many on both sides.
[[nodiscard]] std::size_t terms_of(const ArmChain& chain, const LinkFrame& target,
                                   const CoupledChoice& choice);

/// Returns the joints a and b, with what values of the others make of the loop.
[[nodiscard]] PairInLoop pair_in_loop(const ArmChain& chain, const LinkFrame& target,
                                      const CoupledChoice& choice,
                                      std::span<const Interval> searched);

class CoupledAxes final : public RootSystem {
 public:
  /// Which equations are those of a system, and which other ones its solutions meet. With two unknowns the arm turns
  /// about one direction alone. Then both axes that turn have it, L is fixed, and the equations of P are all: k·P and
  /// |P|², or e·P and f·P.
  struct Rows {
    std::vector<std::size_t> searched, also;
  };
  [[nodiscard]] static Rows rows_of(std::size_t unknowns, bool turns);

  CoupledAxes(std::shared_ptr<const TrigForms> equations, Rows rows)
      : equations_(std::move(equations)), rows_(std::move(rows)) {}

  void evaluate(std::span<const Box> boxes, bool has_rates) override {
    boxes_.assign(boxes.begin(), boxes.end());
    has_rates_ = has_rates;
  }
  [[nodiscard]] std::optional<Values> at(std::size_t lane) const override;

 private:
  const std::shared_ptr<const TrigForms> equations_;
  const Rows rows_;
  std::vector<Box> boxes_;
  bool has_rates_ = false;
};

}  // namespace regulus::detail
