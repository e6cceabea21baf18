// SPDX-License-Identifier: GPL-3.0-or-later
// Kept apart from emit.hpp, so that who only compiles the text needs no more than strings.
#pragma once

#include <string>

namespace regulus::inline cpp {

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
  std::string manifest;  ///< JSON: what the kernel computes, from what; empty unless asked for
};

}  // namespace regulus::inline cpp
