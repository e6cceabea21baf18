// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace regulus::detail {

/// The exit codes of the process. Verdicts come first; the others follow sysexits.h.
enum ExitCode : int {
  kNoSingularity = 0,
  kSingularity = 1,
  kPossibleProblem = 2,
  kUsageError = 64,
  kBadInput = 65,
  kInternalFault = 70,
  kFileError = 74,
};

}  // namespace regulus::detail
