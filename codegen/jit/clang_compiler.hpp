// SPDX-License-Identifier: GPL-3.0-or-later
// The program's side of the compiler plugins.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "regulus/codegen/jit/compilation.hpp"
#include "regulus/codegen/jit/compiled_parts.hpp"

namespace regulus::codegen {

/// The plugin cannot be opened: the installation is incomplete.
class CompilerUnavailable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// "PATH SIZE SECONDS.NANOSECONDS", or "PATH absent": changes when the file is exchanged.
[[nodiscard]] std::string file_identity(const std::filesystem::path& file);

struct CompiledObject {
  std::string object;  ///< ELF, relocatable, or a bundle of them; empty when the text has an error
  std::string diagnostics;  ///< of the compiler; may be there without an error
  std::string not_read;     ///< why it took a C++ compiler, where the text is no plain kernel
  double open_seconds = 0;  ///< loading the compiler, the first time
  double front_end_seconds = 0;
  double optimiser_seconds = 0;
  double code_generation_seconds = 0;
};

/// LLVM and Clang in this process, in plugins: 200 MB of libraries that a run with a warm cache
/// never loads. Emitted kernels are read and built with LLVM alone; any other C++ text takes Clang.
class ClangCompiler {
 public:
  /// Looks for the plugins in the folder that REGULUS_PLUGINS names, then beside the executable as
  /// they are installed or built, then in regulus_plugin_folder().
  ClangCompiler();

  /// Version of Clang and, of each library that takes part, the size and the time of the last
  /// change: enough to notice an exchanged compiler without loading it.
  [[nodiscard]] const std::string& identity() const noexcept { return identity_; }

  /// Opens the plugins it needs if this is the first time, and compiles.
  /// Ensures   the caller's floating-point environment is kept; the compiler sees the default one.
  /// Throws    CompilerUnavailable.
  /// With `parts`, what is known there is left out: CompiledParts::complete adds it.
  [[nodiscard]] CompiledObject compile(const Compilation& compilation,
                                       const CompiledParts* parts = nullptr) const;

  /// As compile, but as C++ whatever the text: the reference for what compile makes of a kernel.
  [[nodiscard]] CompiledObject compile_any(const Compilation& compilation) const;

 private:
  [[nodiscard]] CompiledObject read(const Compilation& compilation,
                                    const CompiledParts* parts) const;

  std::filesystem::path reader_;
  std::filesystem::path plugin_;
  std::string identity_;
};

}  // namespace regulus::codegen
