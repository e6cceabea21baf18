// SPDX-License-Identifier: GPL-3.0-or-later
// The command `verify` by several ranks: each proves some of the shards of an index.
#pragma once

#include "codegen/use/command/command_line.hpp"
#include "codegen/use/mpi/agreement.hpp"
#include "codegen/use/mpi/communicator.hpp"

namespace regulus::detail {

/// All ranks call it together; `ranks` is needed on rank 0, which prints the answer. Returns the
/// exit code of this rank.
[[nodiscard]] int verify_together(Communicator& communicator, const VerifyCommand& command,
                                  const std::vector<RankIdentity>& ranks);

}  // namespace regulus::detail
