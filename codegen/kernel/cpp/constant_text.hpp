// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "codegen/kernel/program/program.hpp"

namespace regulus::detail {

/// Returns a constant expression for readers, "1/180*pi"; empty if it would be long.
[[nodiscard]] std::string constant_text(const Program& program, NodeId id);

}  // namespace regulus::detail
