// SPDX-License-Identifier: GPL-3.0-or-later
// Compiles C++ text to machine code, with Clang.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "codegen/kernel/jit/compilation.hpp"
#include "codegen/kernel/jit/loaded_text.hpp"

namespace regulus::detail {

struct CompiledObject {
  std::string object;       ///< ELF, relocatable; empty if the text has an error
  std::string diagnostics;  ///< of the compiler; possible without an error
  double open_seconds = 0;  ///< loading the compiler, the first time
  double front_end_seconds = 0;
  double optimiser_seconds = 0;
  double code_generation_seconds = 0;
};

/// Clang in this process, in a plugin: any C++ text becomes an object.
class ClangCompiler {
 public:
  ClangCompiler();

  /// Returns the version of Clang and, for each library of the compiler, the size and the time of
  /// the last change. This shows an exchanged compiler without loading it.
  [[nodiscard]] const std::string& identity() const noexcept { return identity_; }

  /// Opens the plugin at the first call, and compiles. Any number of threads may call it.
  /// Ensures   the caller's floating-point environment is kept; the compiler sees the default one.
  /// Throws    CompilerUnavailable.
  [[nodiscard]] CompiledObject compile(const Compilation& compilation) const;

  /// Brings the object of a text of a kernel into memory, by LLVM's linker. It may call
  /// kernel_externals().
  ///
  /// Throws    LoadError for bytes that are not such an object, for an object that would have to
  ///           run when it is loaded, and for a symbol that is not defined; CompilerUnavailable.
  [[nodiscard]] LoadedText load(std::string_view object) const;

 private:
  std::filesystem::path plugin_;
  std::string identity_;
};

}  // namespace regulus::detail
