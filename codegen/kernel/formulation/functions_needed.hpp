// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "codegen/kernel/formulation/formulation.hpp"
#include "runtime/problem/problem.hpp"

namespace regulus::detail {

/// Returns the functions that a method calls; the others need not be formed or compiled.
[[nodiscard]] FormulationOptions functions_needed(
    Method method, const Settings& settings = {},
    std::uint64_t symbolic_budget = kDeterminantBudget);

}  // namespace regulus::detail
