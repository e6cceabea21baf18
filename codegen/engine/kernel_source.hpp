// SPDX-License-Identifier: GPL-3.0-or-later
// Compiled kernels whose arithmetic has been tested.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "codegen/cpp/emitted_kernel.hpp"
#include "codegen/jit/jit.hpp"
#include "runtime/machine/pack_program.hpp"

namespace regulus::inline engine {

/// A kernel is made from this. Nothing in it belongs to GiNaC or CLN, so that threads may share it.
using SharedProgram = std::shared_ptr<const machine::PackKernel>;

/// Compiles a program with LLVM, or finds it in the cache.
///
/// Throws    CompileError, NoCompiler; InternalError when compiled code does not round outward.
[[nodiscard]] CompiledKernel compile(const machine::PackKernel& program,
                                     const CompileOptions& options);
/// Compiles the C++ text with Clang, or finds it in the cache. Throws the same.
[[nodiscard]] CompiledKernel compile(const EmittedKernel& text, const CompileOptions& options);

/// Throws InternalError unless compiled code rounds outward; CompileError and NoCompiler, too, if
/// the cache does not have the code that this is tested with.
void require_sound_rounding(const CompileOptions& options);
/// Throws InternalError if there is a failure.
void require_sound_rounding(const std::optional<std::string>& failure);

}  // namespace regulus::inline engine
