// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "codegen/kernel/symbolic/variable.hpp"
#include "codegen/model/model.hpp"

namespace regulus::detail {

/// Returns the range of a variable after ranges or tolerances have changed, exactly. That of a
/// control error does not change.
///
/// Requires  the variable is one of this model and motion.
[[nodiscard]] Range range_at(const Model& model, const Motion& motion, const Variable& variable);

}  // namespace regulus::detail
