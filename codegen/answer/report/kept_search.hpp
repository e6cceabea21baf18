// SPDX-License-Identifier: GPL-3.0-or-later
// A search for regularity that is kept in a file with its whole tree, so that a run which continues
// has all of its boxes, in their order.
//
// An interrupt or the limit of time ends it between two rounds or units, so that a run which continues
// takes the same boxes as a run without a stop.
//
// The file is not trusted: the leaves are judged again (runtime/search/retold_tree.hpp). What else it
// says of the search changes which boxes come next, and counts that are reported.
#pragma once

#include <atomic>
#include <chrono>
#include <string>

#include "codegen/answer/report/search_checkpoint.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "runtime/checkpoint/checkpoint.hpp"

namespace regulus::detail {

class KeptSearch final : public Observer {
 public:
  /// `file`: null: nothing is kept. `place`: the key of the search in the file, which may be kept for
  /// several searches. `interval`: seconds between two saves, at most.
  KeptSearch(JsonCheckpoint* file, std::string place, double interval);

  /// Runs the search, or continues it. Then `observer` is first told of all splits and leaves of
  /// earlier runs. Throws InputError if the file has no such search.
  [[nodiscard]] Result run(PreparedSearch& preparation, const SearchOptions& search,
                           const Settings& settings, Observer& observer);

  void on_start(const Problem& problem, const Settings& settings) noexcept override;
  void on_split(const OpenBox& box, const Split& split) noexcept override;
  void on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept override;
  void on_open(const OpenBox& box) noexcept override { observer_->on_open(box); }
  void on_progress(const Statistics& statistics, std::uint64_t frontier) noexcept override;
  [[nodiscard]] bool wants_pause() noexcept override;
  void on_pause(const SearchState& state, const OpenBoxes& open) noexcept override;
  void on_finish(const Result& result) noexcept override { observer_->on_finish(result); }

 private:
  [[nodiscard]] Result run_here(PreparedSearch& preparation, const SearchOptions& search,
                                const Settings& settings);
  [[nodiscard]] bool is_interrupted() const { return interrupt_ != nullptr && *interrupt_; }
  [[nodiscard]] Checkpoint restore(const Problem& problem, Settings& settings, Observer& observers);
  [[nodiscard]] Checkpoint read_state() const;
  void save(const SearchState& state, const OpenBoxes& open);
  void save_end(const Result& result);

  JsonCheckpoint* const file_;
  const std::string place_;
  SavePace pace_;
  CheckpointedQuestion question_;
  Observer* observer_ = nullptr;
  const std::atomic<bool>* interrupt_ = nullptr;  ///< from outside
  std::chrono::steady_clock::time_point deadline_;
  std::atomic<bool> stop_ = false;  ///< after a round: an interrupt, or the time is over
  SavedTree tree_;
  BoxId next_id_ = 1;
  bool has_started_ = false;
  bool is_whole_ = true;  ///< false: memory ran out, or the tree was not told again to its end
};

}  // namespace regulus::detail
