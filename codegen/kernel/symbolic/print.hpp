// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "codegen/kernel/symbolic/expression.hpp"

namespace regulus::detail {

/// Returns the expression in the syntax of model files: x*(k_1_1 + k_1_2) - 3*sin(psi)^2.
[[nodiscard]] std::string to_string(const Expression& expression);

}  // namespace regulus::detail
