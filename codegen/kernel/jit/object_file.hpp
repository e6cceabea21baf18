// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "codegen/kernel/jit/compilation.hpp"
#include "runtime/kernel/isa.hpp"

namespace regulus::detail {

/// Compiles a file of a generated kernel, NAME_<isa>.cpp, by Clang in this process. `headers`: the
/// generated files that it includes.
///
/// Returns   an ELF object for x86-64 that links like the object of another compiler; it calls
///           functions of the runtime library.
/// Ensures   code generation for vectors is optimised: it takes longer than for a search, and the
///           code is smaller. Any number of threads may call it.
/// Throws    NoCompiler, CompileError.
[[nodiscard]] std::string compile_object_file(NamedText source,
                                              const std::vector<NamedText>& headers, Isa isa);

}  // namespace regulus::detail
