// SPDX-License-Identifier: GPL-3.0-or-later
// Accounts for what an operation adds to a written expression, before it is carried out.
#pragma once

#include <vector>

#include "regulus/codegen/model/term.hpp"

namespace regulus::codegen {

// Each returns a Term that has everything of its operands but the value, and throws Refusal when it
// would exceed a limit of term.hpp. Coefficients of a sum or product have at most the bits of all
// operands together, those of a power |exponent| times as many.

[[nodiscard]] Term grow(const std::vector<Operand>& operands);
[[nodiscard]] Term grow(const std::vector<Term>& operands);
/// value: the exponent's.
[[nodiscard]] Term grow_by_power(const Term& base, const Term& exponent,
                                 const GiNaC::numeric& value);

}  // namespace regulus::codegen
