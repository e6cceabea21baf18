// SPDX-License-Identifier: Apache-2.0
// Exactly one complex root of a polynomial system in a box: the test of Krawczyk for rectangles.
//
// A box is the set of all z ∈ ℂⁿ with |re(z_i − c_i)| ≤ r_i and |im(z_i − c_i)| ≤ r_i. Let K be a
// complex n×n matrix, E = KF′ − I over the box, e_ij ≥ |re E_ij| + |im E_ij|. If, for all i,
//
//     max(|re (KF(c))_i|, |im (KF(c))_i|) + Σ_j e_ij r_j < r_i,
//
// then F has exactly one root in the box, and F′ is regular all over it, so that the root is a
// simple one. (SOUNDNESS.md derives it.) If F has real coefficients and c is real, the root is real:
// its conjugate is a root, and lies in the box.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "runtime/solutions/complex.hpp"

namespace regulus::detail {

/// n polynomials with real coefficients in n unknowns. If coefficients are known by enclosures only,
/// what is certain of the system is so for all of these coefficients.
class PolynomialSystem {
 public:
  virtual ~PolynomialSystem() = default;
  [[nodiscard]] virtual std::size_t size() const noexcept = 0;
  /// Encloses the values (n) and the derivatives (n×n, row-major: by equation) over a box.
  virtual void enclose(std::span<const Rectangle> z, std::span<Rectangle> values,
                       std::span<Rectangle> derivatives) const = 0;
};

/// A box with exactly one root, which is simple.
struct RootBox {
  std::vector<Complex> center;
  std::vector<double> radius;
  bool is_real = false;  ///< the root is real; otherwise it certainly is not

  [[nodiscard]] Rectangle operator[](std::size_t i) const;
};

/// Proves a root near a place. A place that is almost real is first tried as a real one.
///
/// Returns   a narrow box of one root, with is_real decided; nullopt if none is proved.
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] std::optional<RootBox> certify_root(const PolynomialSystem& system,
                                                  std::span<const Complex> near);

/// True if no place is in both boxes: then their roots are two.
[[nodiscard]] bool certain_disjoint(const RootBox& a, const RootBox& b);

}  // namespace regulus::detail
