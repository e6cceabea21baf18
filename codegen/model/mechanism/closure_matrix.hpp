// SPDX-License-Identifier: GPL-3.0-or-later
// The matrix of a mechanism that is given by equations: the derivatives by its unknowns.
#pragma once

#include "codegen/model/model.hpp"

namespace regulus {

/// Returns ∂Φ/∂unknowns: a row an equation, a column an unknown.
///
/// Ensures   an entry has no value where abs is taken of 0 that depends on the unknown.
[[nodiscard]] GiNaC::matrix closure_matrix(const Closure& closure);

/// Returns a bound of the number of nodes in the derivative of an expression by a symbol, as it is
/// formed; linear in the size of the expression.
[[nodiscard]] double derivative_size(const GiNaC::ex& expression, const GiNaC::ex& symbol);

}  // namespace regulus
