// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the cranks of rotary legs in the entries of a matrix.
#pragma once

#include <optional>

#include "codegen/kernel/symbolic/expression.hpp"

namespace regulus::detail {

/// A unit vector (C, S) in the plane of f and g, as the closure of a crank and its rod gives it:
///
///   C = (k·f + W·g)/q,  S = (k·g − W·f)/q,  q = f² + g²,  W = ±√(q − k²).
///
/// (f, g) goes from the motor to the end of the rod, k = C·f + S·g is its part along the crank, and
/// W = C·g − S·f that across it, 0 at the leg's dead point.
struct Crank {
  Expression f, g, k;
  int sign;  ///< of W
  /// The root in the quotient: root_factor·|W|.
  Expression root;
  cln::cl_RA root_factor;
  /// The c for which c·k is (f² + g²)/2 plus terms without one of f and g, if the expressions show
  /// it: the crank's length.
  std::optional<cln::cl_RA> length;
};

/// A product of `factor` and a coordinate of a crank.
struct CrankCoordinate {
  Crank crank;
  bool is_sine;
  Expression factor;
};

/// Returns numerator/denominator as a multiple of a coordinate of a crank, if it is one.
///
/// Ensures   the same function wherever the quotient is defined: an identity of polynomials in f, g,
///           k and W is checked exactly.
[[nodiscard]] std::optional<CrankCoordinate> find_crank(const Expression& numerator,
                                                        const Expression& denominator);

}  // namespace regulus::detail
