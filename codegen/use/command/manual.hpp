// SPDX-License-Identifier: GPL-3.0-or-later
// Manual pages, from the tables of the command line itself.
#pragma once

#include <string>
#include <vector>

#include "codegen/use/command/command_line.hpp"

namespace regulus::detail {

/// A page in the man macros: regulus(1) for the entry without a name, regulus-check(1) for check.
[[nodiscard]] std::string manual_page(const CommandEntry& command,
                                      const std::vector<CommandEntry>& table);

}  // namespace regulus::detail
