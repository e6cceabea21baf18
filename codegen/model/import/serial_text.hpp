// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "codegen/model/import/chain.hpp"
#include "codegen/model/import/identifiers.hpp"

namespace regulus::detail {

/// Returns the tables [serial], [motion.limits] and, if it is within the limits, [motion.home] of a
/// model file. Assumptions are added to `notes`.
[[nodiscard]] std::string serial_text(const Chain& chain, const std::string& file,
                                      Identifiers& identifiers, std::vector<std::string>& notes);

/// Returns the number as a value of TOML.
[[nodiscard]] std::string toml_number(const WrittenNumber& number);

}  // namespace regulus::detail
