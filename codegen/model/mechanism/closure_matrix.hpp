// SPDX-License-Identifier: GPL-3.0-or-later
// The matrix of a mechanism that is given by equations: the derivatives by its unknowns.
#pragma once

#include "codegen/model/model.hpp"

namespace regulus::detail {

/// Returns the expression with the root of a square for each absolute value, which GiNaC turns into
/// conjugates when it forms a derivative. Its derivatives have no value where abs has none.
[[nodiscard]] GiNaC::ex differentiable(const GiNaC::ex& expression);

/// Returns ∂Φ/∂unknowns: a row an equation, a column an unknown.
[[nodiscard]] GiNaC::matrix closure_matrix(const Closure& closure);

/// Returns a bound of the number of nodes in the derivative of an expression by a symbol, as it is
/// formed; linear in the size of the expression.
[[nodiscard]] double derivative_size(const GiNaC::ex& expression, const GiNaC::ex& symbol);

}  // namespace regulus::detail
