// SPDX-License-Identifier: GPL-3.0-or-later
// Checks a motion along a trajectory.
//
// All pieces are searched first, with one kernel (path_search.hpp). Each piece that this does not
// certify gets a search of its own, over its exact parameter: it may certify the piece, or find a
// singular pose on it.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "codegen/question/engine/options.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/engine/search_topic.hpp"
#include "codegen/question/way/path_search.hpp"
#include "codegen/question/way/pieces_alone.hpp"

namespace regulus::detail {

/// The piece that decides the verdict, with the search of its own.
struct DecidingPiece {
  std::size_t index = 0;
  std::unique_ptr<PreparedSearch> preparation;  ///< null if it was not searched by itself
  Result result;
};

/// The program around a search: an interrupt, a display of progress, a file. All may be null.
struct PathWatch {
  const std::atomic<bool>* interrupt = nullptr;
  Observer* display = nullptr;
  const SearchCheckpoint* checkpoint = nullptr;
  SearchTopic topic{};  ///< of all searches, without their pieces

  [[nodiscard]] JsonCheckpoint* file() const {
    return checkpoint != nullptr ? checkpoint->file() : nullptr;
  }
  [[nodiscard]] double interval() const {
    return checkpoint != nullptr ? checkpoint->interval() : 0;
  }

  [[nodiscard]] bool is_interrupted() const {
    return interrupt != nullptr && interrupt->load(std::memory_order_relaxed);
  }
};

/// Returns the key of the search of a piece in the file.
[[nodiscard]] std::string place_of_piece(std::size_t piece);

struct TrajectoryCheck {
  Request request;  ///< with the trajectory
  PreparedSearch hull;
  Engine engine = Engine::kInterpreted;  ///< that was used
  Verdict verdict = Verdict::kPossibleProblem;
  Reason reason = Reason::kBadProblem;
  std::optional<DecidingPiece> deciding;  ///< none for NO SINGULARITY
  PathSearchResult path;                  ///< with the trees of all pieces, if they are wanted
  std::size_t searched_alone = 0;         ///< pieces with a search of their own
  bool can_continue = false;              ///< a limit or an interrupt ended a search
  StageSeconds seconds;
};

/// Throws as `prepare`. `request`: its motion has a trajectory, which took `model_seconds` to read.
[[nodiscard]] TrajectoryCheck check_trajectory(Request request, double model_seconds,
                                               SearchOptions search, bool wants_trees,
                                               const PathWatch& watch);

}  // namespace regulus::detail
