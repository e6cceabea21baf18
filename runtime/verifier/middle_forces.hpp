// SPDX-License-Identifier: Apache-2.0
// Approximate forces that hold a wrench at one pose, as far from their limits as possible.
#pragma once

#include <vector>

#include "runtime/verifier/linear_algebra.hpp"

namespace regulus::verifier {

/// The matrix at one pose, with each row in units of half of the range of its force, so that forces
/// within the limits are offsets u with |u_i| ≤ 1. A row of zeros means a force that is given.
struct ScaledRows {
  std::size_t rows = 0, columns = 0;
  std::vector<double> B;            ///< row by row
  Matrix inverse;                   ///< columns × rows, the pseudo-inverse of B
  std::vector<bool> has_no_limits;  ///< by row: |u_i| does not count
};

struct MiddleForces {
  std::vector<double> offsets;    ///< u with Bᵀu = needed and a small max |u_i|
  std::vector<double> direction;  ///< y: yᵀneeded/Σ|By|_i is roughly that maximum
};

/// Minimises max |u_i| by Newton's method on its logarithmic barrier. Nothing is claimed about the
/// result, which need not be finite.
[[nodiscard]] MiddleForces approx_middle_forces(const ScaledRows& scaled,
                                                const std::vector<double>& needed);

}  // namespace regulus::verifier
