// SPDX-License-Identifier: GPL-3.0-or-later
// Expressions of GiNaC as text of model files.
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "codegen/model/exact/parsed_expression.hpp"

namespace regulus::detail {

/// Returns text that parse_expression reads as that expression; symbols become names.
///
/// Ensures   the same in every process: operands are in the order of their texts, since GiNaC's own
///           order depends on addresses. Throws ParseRefusal for a number that is not an exact real, and
///           for functions and constants that model files do not have.
[[nodiscard]] std::string formula_text(const GiNaC::ex& expression);

/// Returns each symbol once.
[[nodiscard]] std::vector<GiNaC::ex> symbols_of(const GiNaC::ex& expression);

}  // namespace regulus::detail
