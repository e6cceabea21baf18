// SPDX-License-Identifier: GPL-3.0-or-later
// What the rewriting passes try to make small.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "regulus/codegen/symbolic/expression.hpp"

namespace regulus::codegen {

/// How often each variable appears in the printed form. Saturates at the largest value.
using Occurrences = std::map<std::string, std::uint64_t>;

[[nodiscard]] Occurrences count_occurrences(const Expressions& expressions);
[[nodiscard]] Occurrences count_occurrences(const Expression& expression);
[[nodiscard]] std::uint64_t total(const Occurrences& occurrences) noexcept;

/// Operations when every sub-expression common to the expressions is evaluated once.
[[nodiscard]] std::uint64_t count_operations(const Expressions& expressions);

/// What a form costs in width: two for each appearance of a variable, one if it is the argument of
/// a sine or cosine. sin(t) and cos(t) come in pairs that share the variable's motion (their
/// derivatives' squares add up to one), so that a pair weighs as much as one bare variable.
[[nodiscard]] std::uint64_t width_cost(const Expression& expression);

}  // namespace regulus::codegen
