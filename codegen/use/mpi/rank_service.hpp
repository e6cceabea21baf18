// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "codegen/answer/asked.hpp"
#include "codegen/answer/services.hpp"
#include "codegen/use/mpi/communicator.hpp"

namespace regulus::detail {

/// Decides units of a question for rank 0, which asks it, until rank 0 dismisses this rank. Errors go
/// to rank 0. The services are those of rank 0.
void serve_first_rank(Communicator& communicator, const Asked& asked, const Services& services);

}  // namespace regulus::detail
