// SPDX-License-Identifier: GPL-3.0-or-later
// Functions for commands in which each rank does a part of the work by itself.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "codegen/use/mpi/communicator.hpp"

namespace regulus::detail {

/// Each rank has no more than its part, and nothing to save: a signal ends the process.
void unblock_signals();

/// As Communicator::gather(). A rank may be at work for long: it is named now and then, and given up
/// some time after `limit` seconds; 0: never.
[[nodiscard]] std::vector<std::optional<std::string>> gather_parts(Communicator& communicator,
                                                                   const std::string& own,
                                                                   double limit);

}  // namespace regulus::detail
