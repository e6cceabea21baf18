// SPDX-License-Identifier: GPL-3.0-or-later
// The quantity of a command line, and its limit.
#pragma once

#include <string>

#include "codegen/model/request.hpp"
#include "codegen/quantity/quantity.hpp"

namespace regulus::inline command {

/// Reads the model; a quantity that is no word is an expression of it. Throws UsageError.
[[nodiscard]] Request read_asked(ModelOptions model, const QuantityOptions& quantity);

/// Throws    UsageError for a text that is not a constant, or is not positive where it must be.
[[nodiscard]] GiNaC::ex read_limit(const std::string& text, const Quantity& quantity);

}  // namespace regulus::command
