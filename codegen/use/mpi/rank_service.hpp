// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "codegen/question/engine/pipeline.hpp"
#include "codegen/use/mpi/communicator.hpp"
#include "runtime/cluster/workers.hpp"

namespace regulus {

/// The question of the next searches.
struct RankQuestion {
  PreparedSearch prepared;
  /// Makes judges of boxes (runtime/search/box_judges.hpp) for a problem of the question; empty: its
  /// searches are those of Algorithm 1.
  std::function<cluster::MakeDecider(const Problem&)> judges{};
};

/// Prepares the question of the command line, or that of a topic (see Workers::turn_to).
using PrepareQuestion = std::function<RankQuestion(std::optional<std::string_view> topic)>;

/// Prepares questions and decides units of them for rank 0, until rank 0 dismisses this rank. Errors
/// go to rank 0. `has_topics`: the first question comes from rank 0, as those after it.
void serve_first_rank(Communicator& communicator, const SearchOptions& search, bool has_topics,
                      const PrepareQuestion& prepare_question);

}  // namespace regulus
