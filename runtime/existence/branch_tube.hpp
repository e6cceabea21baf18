// SPDX-License-Identifier: Apache-2.0
// Exactly one solution over a box: the parametric test of Krawczyk for a system Φ(x, p) = 0 of n
// equations in n unknowns p, where x, of m variables, is asked about.
//
// A tube over a box X of x is the set of all (x, p) with x ∈ X and p = c + S(x − x₀) + ρ, |ρ| ≤ r.
// x₀ need not lie in X. Let Z be a box that contains the tube over the hull of X and x₀, Φ be defined
// and continuously differentiable on Z, K an n×n matrix, D = K(Φ_x + Φ_p S) and E = KΦ_p − I over Z. If
//
//     |K Φ(x₀, c)| + |D|·|X − x₀| + |E|·r < r      in every component,
//
// then for every x ∈ X exactly one p of the tube solves Φ(x, p) = 0, it is a continuously
// differentiable function of x, its |ρ| is less than r, and Φ_p is regular all over the tube.
// (SOUNDNESS.md derives it.)
//
// In the test of second order, D and E of the sum are means along segments from (x₀, c): there only
// half of what they change by counts. |E|·r < r is needed besides, for E over Z.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "runtime/interval/interval.hpp"

namespace regulus::detail {

struct BranchTube {
  std::vector<double> at;      ///< x₀, by variable
  std::vector<double> center;  ///< c, by unknown
  std::vector<double> slopes;  ///< S, n×m, row-major
  std::vector<double> radius;  ///< r > 0, by unknown

  friend bool operator==(const BranchTube&, const BranchTube&) = default;
};

/// Encloses the unknowns of the tube over a box of the variables.
///
/// Shape     box: m; the result: n.
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] std::vector<Interval> enclose(const BranchTube& tube, std::span<const Interval> box);

/// True if, for every place of the box, all these unknowns are in the tube.
///
/// Shape     box: m; unknowns: n.
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] bool certain_holds(const BranchTube& tube, std::span<const Interval> box,
                                 std::span<const Interval> unknowns);

/// A system over a tube.
struct TubeSystem {
  std::span<const Interval> value;        ///< encloses Φ(x₀, c); n
  std::span<const Interval> by_unknown;   ///< encloses Φ_p over Z; n×n, row-major
  std::span<const Interval> by_variable;  ///< encloses Φ_x over Z; n×m, row-major
  // Empty, or for a test of second order:
  std::span<const Interval> center_by_unknown{};   ///< encloses Φ_p(x₀, c)
  std::span<const Interval> center_by_variable{};  ///< encloses Φ_x(x₀, c)
  /// Enclose over Z the derivatives of Φ_p and of Φ_x by each variable and then by each unknown:
  /// (m + n)·n·n and (m + n)·n·m.
  std::span<const Interval> rates_by_unknown{};
  std::span<const Interval> rates_by_variable{};
};

/// The parts of the left side of the test; upper bounds, not negative, or infinite.
struct TubeImage {
  std::vector<double> radius;  ///< the left side, by unknown
  std::vector<double> offset;  ///< |K Φ(x₀, c)|, by unknown
  std::vector<double> impact;  ///< |D_ik|·|X_k − x₀_k|, n×m, row-major
  std::vector<double> spread;  ///< |E|, n×n, row-major
  std::vector<double> change;  ///< |E|·r, by unknown
};

/// Requires  Z contains the tube over the hull of X and x₀; Φ is continuously differentiable on Z. An
///           enclosure of a slope at a kink, as of |a| at 0, is none of a derivative.
/// Shape     box: m; inverse: K, n×n, row-major, finite; the tube's numbers are finite.
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] TubeImage image_of(const BranchTube& tube, std::span<const Interval> box,
                                 std::span<const double> inverse, const TubeSystem& system);

/// True if the test above holds: the image is finite and strictly smaller than the tube, and so is
/// |E|·r.
[[nodiscard]] bool has_one_solution(const BranchTube& tube, const TubeImage& image);

/// Inverts an n×n matrix, approximately, and destroys it. Returns false if elimination finds no inverse.
[[nodiscard]] bool approx_invert(std::span<double> matrix, std::span<double> inverse,
                                 std::size_t n) noexcept;

/// Returns the inverse of an n×n matrix, approximately; nullopt if elimination finds none.
[[nodiscard]] std::optional<std::vector<double>> approx_inverse_of(std::span<const double> matrix,
                                                                   std::size_t n);

}  // namespace regulus::detail
