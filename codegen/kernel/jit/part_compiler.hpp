// SPDX-License-Identifier: GPL-3.0-or-later
// Compiles the parts of pack programs to machine code, with LLVM alone.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/kernel/isa.hpp"

namespace regulus::detail {

struct CompiledParts {
  std::vector<std::string> codes;  ///< flat code (part.hpp) of each part; empty after a failure
  std::string diagnostics;
  double open_seconds = 0;  ///< loading the compiler, the first time
  double front_end_seconds = 0;
  double code_generation_seconds = 0;
};

class PartCompiler {
 public:
  PartCompiler();

  /// Returns the version of LLVM, and the size and the time of the last change of each library of
  /// the compiler.
  [[nodiscard]] const std::string& identity() const noexcept { return identity_; }

  /// Each code is a PartFunction (part_code.hpp). Opens the plugin at the first call; spreads many parts over threads. Any number of threads may call it.
  ///
  /// Requires  bytes of part_bytes.
  /// Ensures   equal bytes give equal code. The caller's floating-point environment is kept; the
  ///           compiler sees the default one.
  /// Throws    CompilerUnavailable.
  [[nodiscard]] CompiledParts compile(const std::vector<std::string_view>& parts, Isa isa) const;

 private:
  std::filesystem::path plugin_;
  std::string identity_;
};

}  // namespace regulus::detail
