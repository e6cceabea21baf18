// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace regulus::detail::bench {

struct ProcessRun {
  int exit_code = -1;       ///< −1: no such program, or a signal ended it
  double wall_seconds = 0;  ///< from before its start until its end has been waited for
  std::string output;       ///< standard output and standard error
};

/// Runs a program, found in PATH unless its name has a slash, and waits for it.
///
/// Shape     environment: "NAME=VALUE", added to the environment of this process.
[[nodiscard]] ProcessRun run_process(const std::vector<std::string>& command,
                                     const std::vector<std::string>& environment = {});

}  // namespace regulus::detail::bench
