// SPDX-License-Identifier: GPL-3.0-or-later
// What the rewriting passes try to make small.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>

#include "codegen/symbolic/expression.hpp"

namespace regulus::inline symbolic {

/// How often each variable appears in the printed form. Saturates at the largest value.
using Occurrences = std::map<std::string, std::uint64_t>;

[[nodiscard]] Occurrences count_occurrences(const Expressions& expressions);
[[nodiscard]] Occurrences count_occurrences(const Expression& expression);
[[nodiscard]] std::uint64_t total(const Occurrences& occurrences) noexcept;

/// Nodes of the printed form, where shared sub-expressions are written out each time.
[[nodiscard]] std::uint64_t printed_size(const Expression& expression);

/// Operations when every sub-expression common to the expressions is evaluated once.
[[nodiscard]] std::uint64_t count_operations(const Expressions& expressions);

/// How much an occurrence of a variable matters; 1 if not listed.
using Weights = std::unordered_map<std::string, std::uint64_t>;

/// What a form costs in width: twice the weight for each appearance of a variable, once if it is in
/// the argument of a sine or cosine. sin(t) and cos(t) come in pairs that share the variable's
/// motion (their derivatives' squares add up to one), so that a pair costs as much as one variable.
[[nodiscard]] std::uint64_t width_cost(const Expression& expression, const Weights& weights = {});

}  // namespace regulus::inline symbolic
