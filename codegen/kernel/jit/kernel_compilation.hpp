// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "codegen/kernel/jit/clang_interface.h"
#include "codegen/kernel/jit/compilation.hpp"
#include "runtime/kernel/isa.hpp"

namespace regulus::detail {

/// Returns the compilation of a kernel's text: the headers, flags and passes of every kernel for
/// `isa`.
[[nodiscard]] Compilation kernel_compilation(std::string_view text, Isa isa);

/// Returns the functions that a kernel may call.
[[nodiscard]] std::vector<regulus_external> kernel_externals();

}  // namespace regulus::detail
