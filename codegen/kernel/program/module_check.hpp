// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "codegen/kernel/program/module.hpp"

namespace regulus::detail {

/// Throws std::invalid_argument, with the function's name, unless the module can become a kernel:
/// each function is a field of regulus_kernel that occurs once, has as many outputs as the ABI
/// says, reads exactly the module's variables and all of K or nothing of it, and is well formed
/// (operands before their use, indices declared).
void check_module(const Module& module);

}  // namespace regulus::detail
