// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "codegen/kernel/formulation/formulation.hpp"
#include "runtime/kernel/isa.hpp"

namespace regulus::detail {

/// Returns the name in the cache of the forms that many questions share: those of one model and one
/// motion that differ only in the values of ranges, tolerances and errors, as far as the symbolic
/// stage makes the same choices for them (typical_ranges.hpp).
///
/// Shape     64 hexadecimal digits.
/// Requires  `natural` has the natural matrix, the row scale, constraints, pose and conditions of
///           the question, formed with the rewriting of `functions`; `program` and `compiler` change
///           whenever either may give another result for a question.
/// Ensures   two questions with the same key have the same functions of the kernel, over the same
///           variables, up to collisions of SHA-256. (The ranges of the variables are no part of
///           the functions.)
[[nodiscard]] std::string forms_key(const Formulation& natural, bool has_threshold,
                                    const FormulationOptions& functions, Isa isa,
                                    std::string_view program, std::string_view compiler);

}  // namespace regulus::detail
