// SPDX-License-Identifier: GPL-3.0-or-later
// Decides for a box of poses whether forces within the limits hold the load.
//
// A: J⁻¹, m×n, m ≥ n; X the box, c a point of it, G the uncertain quantities. Σ_k∂_kA is over the
// motion parameters.
//
// HELD. Let K be any n×m matrix, E = KA − I, and |E| ≤ P at every pose of X and every value of G.
// Let r = w − Aᵀf₀ for any f₀. If some y > 0 has Pᵀ(|r| + y) < y, then Pᵀy < y, so ρ(P) < 1, I + Eᵀ
// is regular, and q = (I + Eᵀ)⁻¹r has q − r = −Eᵀ(r + (q − r)), hence |q − r| ≤ (I − Pᵀ)⁻¹Pᵀ|r| < y,
// because (I − Pᵀ)y > Pᵀ|r| and (I − Pᵀ)⁻¹ ≥ 0. The forces
//
//     f = f₀ + Kᵀq        hold w:   Aᵀf = Aᵀf₀ + (KA)ᵀq = Aᵀf₀ + (I + Eᵀ)q = w.
//
// So w is held within the limits at every pose of X if f₀ + Kᵀr + |Kᵀ|·[−y, y] is within them. The
// forces depend on pose, uncertain values and load, as those of a controller do. By the mean value
// theorem, component by component, with N_k = Kᵀ(∂_kA)ᵀf₀ enclosed over X × G,
//
//     Kᵀr ∈ Kᵀ(w − A(c)ᵀf₀) − Σ_k N_k·(x_k − c_k),        P = |KA(c) − I| + Σ_k |K∂_kA|·|x_k − c_k|.
//
// A part u of the load in a ball of radius R adds Kᵀu to Kᵀr, of which row i is at most R times the
// length of that part of row i of Kᵀ, and R to |r|.
//
// f₀ is the middle of the forces that hold w at c: it has the greatest distance to the limits,
// measured by half of their ranges (a linear program). K distributes a change of the load by the
// same measure.
//
// NOT HELD. If some y has max{fᵀAy : f within the limits} < yᵀw, then no f holds w. The maximum is
// Σ_i max(a_i·lo_i, a_i·hi_i) with a = Ay; y comes from the multipliers of the linear program. With
// g_i the limit that is attained at c, and l_i the other one,
//
//     max fᵀAy ≤ gᵀAy + Σ_i max(0, (l_i − g_i)·a_i).
//
// FREE. Rows F of A belong to constraints, whose forces have no limits. HELD asks nothing of them. NOT HELD
// needs Fy = 0 at each pose. Let W > 0 be diagonal, S any matrix with |I − WFS| ≤ p < 1 in the norm of rows,
// and y₀ any vector. Then WFS is regular, y = y₀ − Sz with WFSz = WFy₀ has Fy = 0, and z = WFy₀ +
// (I − WFS)z gives |z_f| ≤ max|WFy₀|/(1 − p). So y is enclosed, and the two sides are compared over this
// enclosure. S has columns of K in the units of W.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "codegen/question/engine/box_matrices.hpp"
#include "codegen/question/load/force_problem.hpp"
#include "codegen/question/load/left_inverse.hpp"

namespace regulus::detail {

/// The proof that no forces hold a load.
struct Shortage {
  std::size_t corner = 0;         ///< of the load
  std::vector<double> direction;  ///< y
  Interval needed, possible;      ///< yᵀw, and the greatest fᵀAy, at c: needed > possible
};

struct ForceDecision {
  enum class Kind : std::uint8_t { kHeld, kNotHeld, kUnknown } kind = Kind::kUnknown;
  std::optional<Shortage> shortage{};  ///< at c, for every value of G; kNotHeld has one
  bool fails_at_center = true;         ///< kUnknown: HELD was not shown at c alone, either
  std::vector<double> impact{};  ///< kUnknown: roughly what each parameter adds to the failure
};

class ForceTest {
 public:
  /// `problem` must outlive this object. Several threads may use one object.
  explicit ForceTest(const ForceProblem& problem) : problem_(problem) {}

  /// Ensures   kHeld: at every pose of the box and for every value of the uncertain quantities,
  ///           every load is held by forces within the limits. kNotHeld: some load is not, at any
  ///           pose of the box, for any value of them.
  /// Rounding  outward; MXCSR at nearest.
  [[nodiscard]] ForceDecision decide(const BoxMatrix& box) const;

 private:
  const ForceProblem& problem_;
};

}  // namespace regulus::detail
