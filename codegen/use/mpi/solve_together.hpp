// SPDX-License-Identifier: GPL-3.0-or-later
// The command `solve` by several ranks: each solves some of the places of a table.
#pragma once

#include <string>

#include "codegen/use/command/command_line.hpp"
#include "codegen/use/mpi/communicator.hpp"

namespace regulus::detail {

/// All ranks call it together; rank 0 prints the answer, and solves a single place alone. `typed`: the
/// command line. Returns the exit code of this rank.
[[nodiscard]] int solve_together(Communicator& communicator, const SolveCommand& command,
                                 const std::string& typed);

}  // namespace regulus::detail
