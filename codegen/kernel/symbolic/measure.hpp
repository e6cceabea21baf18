// SPDX-License-Identifier: GPL-3.0-or-later
// The measures that the rewriting passes minimise.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>

#include "codegen/kernel/symbolic/expression.hpp"

namespace regulus::detail {

/// The number of times that each variable appears in the printed form. Saturates at the largest
/// value.
using Occurrences = std::map<std::string, std::uint64_t>;

[[nodiscard]] Occurrences count_occurrences(const Expressions& expressions);
[[nodiscard]] Occurrences count_occurrences(const Expression& expression);
[[nodiscard]] std::uint64_t total(const Occurrences& occurrences) noexcept;

/// Counts the nodes of the printed form, in which shared sub-expressions are repeated.
[[nodiscard]] std::uint64_t printed_size(const Expression& expression);

/// Counts the operations if every common sub-expression is evaluated once.
[[nodiscard]] std::uint64_t count_operations(const Expressions& expressions);

/// The weight of an occurrence of a variable; 1 if not listed.
using Weights = std::unordered_map<std::string, std::uint64_t>;

/// The cost of a form in width: twice the weight for each occurrence of a variable, once if it is
/// in the argument of a sine or cosine. sin(t) and cos(t) come in pairs that share the variable's
/// motion (the squares of their derivatives add up to one), so a pair costs as much as one
/// variable.
[[nodiscard]] std::uint64_t width_cost(const Expression& expression, const Weights& weights = {});

}  // namespace regulus::detail
