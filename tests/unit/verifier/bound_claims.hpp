// SPDX-License-Identifier: GPL-3.0-or-later
// Random claims about quantities of a robot with two legs, and their truth in plain doubles.
#pragma once

#include <array>
#include <random>
#include <string>
#include <vector>

namespace regulus::detail::test {

using Vector2 = std::array<double, 2>;

/// The matrix is J⁻¹ = diag(scale)·M with M = [a + b·x, c·x; d, e], x in [lo, hi].
struct BoundClaim {
  std::string kind, side;
  double a = 3, b = 1, c = 1, d = 0, e = 2, lo = 0, hi = 2;
  Vector2 scale{1, 1}, middle{0, 0}, spread{1, 1}, errors{0.125, 0.125}, stiffness{2, 2},
      factor{1, 1};
  double radius = 0;  ///< of a ball in place of the spreads; 0: none
  bool has_norms = false, is_norm = false;
  std::size_t row = 0, column = 0;
  double reference = 0, bound = 1;

  [[nodiscard]] double sign() const { return side == "least" ? -1 : 1; }
  [[nodiscard]] bool is_direct() const { return kind == "sigma-min"; }
};

/// A pose, and the values of the load, the errors or the directions.
struct Place {
  double x = 0;
  std::vector<double> values;
};

/// Returns the quantity at a place: |q| if the side is absolute.
[[nodiscard]] double value_at(const BoundClaim& claim, const Place& place);
/// Returns the place of many at which the quantity is largest, or least.
[[nodiscard]] Place extreme_place(const BoundClaim& claim);
/// Returns a question whose matrix is regular for x in its range.
[[nodiscard]] BoundClaim random_claim(std::mt19937& random);

/// Returns the certificate up to `proof`. Its words are those that the verifier expects.
[[nodiscard]] std::string head_of(const BoundClaim& claim, bool is_attained);
/// Returns the proof of one leaf.
[[nodiscard]] std::string proof_of(const BoundClaim& claim);
/// Returns the proof by two points, next to a place.
[[nodiscard]] std::string witness_of(const BoundClaim& claim, const Place& place);

}  // namespace regulus::detail::test
