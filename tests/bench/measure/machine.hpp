// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace regulus::bench {

/// What the figures depend on besides the code.
struct Machine {
  std::string processor;
  unsigned processors = 0;
  double load = 0;         ///< how many programs wanted a processor in the last minute
  std::string compiler;    ///< of the suite and of everything compiled ahead of time
  std::string in_process;  ///< of everything compiled in process
};

[[nodiscard]] Machine this_machine();

}  // namespace regulus::bench
