// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <llvm/IR/Module.h>

#include "codegen/kernel/jit/llvm/operations.hpp"
#include "codegen/kernel/jit/part.hpp"

namespace regulus::detail::builder {

/// Adds the part to the module as the function kPartSymbol, a PartFunction (part_code.hpp). An
/// operation without a straight form in `packs` becomes a call of the vector machine's step, with
/// its operands in slots of a frame.
///
/// Requires  a part of a function in which find_fault finds none.
/// Throws    std::runtime_error.
void build_part(const PartProgram& part, Operations& packs, llvm::Module& module);

}  // namespace regulus::detail::builder
