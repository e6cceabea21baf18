// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <llvm/IR/Module.h>

#include "regulus/codegen/jit/reader/shares.hpp"
#include "regulus/codegen/jit/reader/syntax.hpp"

namespace regulus::codegen::builder {

/// Adds a share of the functions and tables of a kernel to the module of the packs' operations.
///
/// Ensures   what is neither exported nor for the tables of another share is internal; what the
///           kernel does not use is left for the linker of dead code.
/// Throws    reader::OutsideSubset for a name, type or operation that kernels do not have.
void build_kernel(const reader::KernelText& text, const reader::Symbols& symbols,
                  const reader::Share& share, llvm::Module& module);

}  // namespace regulus::codegen::builder
