// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace regulus::detail::bench {

/// The machine and the compilers, on which the figures depend besides the code.
struct Machine {
  std::string processor;
  unsigned processors = 0;
  double load = 0;         ///< programs that wanted a processor in the last minute
  std::string compiler;    ///< of the suite and of everything compiled ahead of time
  std::string in_process;  ///< of everything compiled in process
};

[[nodiscard]] Machine this_machine();

}  // namespace regulus::detail::bench
