// SPDX-License-Identifier: GPL-3.0-or-later
// Compiled kernels whose arithmetic has been tested.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "codegen/kernel/cpp/emitted_kernel.hpp"
#include "codegen/kernel/jit/jit.hpp"
#include "runtime/machine/pack_program.hpp"

namespace regulus::detail {

/// The source of a kernel. It does not use GiNaC or CLN, so threads may share it.
using SharedProgram = std::shared_ptr<const machine::PackKernel>;

/// Compiles a program with LLVM, or finds it in the cache.
///
/// Throws    CompileError, NoCompiler; InternalError if compiled code does not round outward.
[[nodiscard]] CompiledKernel compile(const machine::PackKernel& program,
                                     const CompileOptions& options);
/// Compiles the C++ text with Clang, or finds it in the cache. Throws the same.
[[nodiscard]] CompiledKernel compile(const EmittedKernel& text, const CompileOptions& options);

/// Throws    InternalError unless compiled code rounds outward. Also throws CompileError and
///           NoCompiler, if the cache does not have the code of the self-test.
void require_sound_rounding(const CompileOptions& options);
/// Throws InternalError if there is a failure.
void require_sound_rounding(const std::optional<std::string>& failure);

}  // namespace regulus::detail
