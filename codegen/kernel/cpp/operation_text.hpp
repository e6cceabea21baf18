// SPDX-License-Identifier: GPL-3.0-or-later
// The C++ text of the operations of packs.
#pragma once

#include <string_view>

#include "codegen/kernel/cpp/expression_text.hpp"
#include "runtime/machine/pack_program.hpp"

namespace regulus::detail {

using BinaryText = ExpressionText (*)(const ExpressionText&, const ExpressionText&);

/// Returns the operator of two operands; null for an operation that is written as a call.
[[nodiscard]] BinaryText sign_of(machine::PackOperation operation) noexcept;

/// Returns the function of an operation that is written as a call; empty for all others.
[[nodiscard]] std::string_view function_name(machine::PackOperation operation) noexcept;

/// True if the function takes the mask of undefined lanes.
[[nodiscard]] bool marks_undefined(machine::PackOperation operation) noexcept;

/// True if the result is exact doubles, a P.
[[nodiscard]] bool is_exact(machine::PackOperation operation) noexcept;

/// P(c).
[[nodiscard]] bool is_literal(machine::PackOperation operation) noexcept;

/// True for sums, products, squares and signs of any operands, which are readable inside an
/// expression.
[[nodiscard]] bool is_sign_or_product(machine::PackOperation operation) noexcept;

}  // namespace regulus::detail
