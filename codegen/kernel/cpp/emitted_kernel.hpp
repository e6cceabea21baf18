// SPDX-License-Identifier: GPL-3.0-or-later
// Separate from emit.hpp, so that code that only compiles the text needs only strings.
#pragma once

#include <string>

namespace regulus::detail {

struct EmitOptions {
  std::string prefix = "generated";   ///< the kernel is the symbol <prefix>_kernel; not "regulus"
  std::string command;                ///< the command line that made it, for the header comment
  std::string source;                 ///< who published the model, for the header comment
  bool manifest = false;              ///< fill EmittedKernel::manifest
  unsigned operations_per_part = 64;  ///< longer functions are cut: see Part in partition.hpp
};

struct EmittedKernel {
  std::string source;    ///< the C++ text
  std::string symbol;    ///< of the regulus_kernel it defines
  std::string identity;  ///< hash of the program, the kernel's `identity`
  std::string manifest;  ///< JSON: inputs and outputs of the kernel; empty unless requested
};

}  // namespace regulus::detail
