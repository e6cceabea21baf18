// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "codegen/engine/pipeline.hpp"
#include "codegen/mpi/communicator.hpp"

namespace regulus::inline mpi {

/// Prepares a question and decides units of it for rank 0, until rank 0 dismisses this rank. Errors
/// go to rank 0.
void serve_first_rank(Communicator& communicator, const SearchOptions& search,
                      const std::function<PreparedSearch()>& prepare_question);

}  // namespace regulus::mpi
