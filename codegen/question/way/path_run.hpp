// SPDX-License-Identifier: GPL-3.0-or-later
// The first stage of every question about a trajectory: one search of all its pieces.
#pragma once

#include <atomic>

#include "codegen/question/engine/options.hpp"
#include "codegen/question/way/trajectory_run.hpp"

namespace regulus {

class PathRun {
 public:
  /// Requires  `check` has its request, and lives as long as this.
  PathRun(TrajectoryCheck& check, const SearchOptions& search, bool wants_trees,
          const std::atomic<bool>* interrupt);

  /// Prepares the kernel of all pieces and searches them. If that is stopped, the reason and the
  /// piece are in `check`, and has_ended() is true. Throws as `prepare`.
  void search_all();

  /// Prepares the search of one piece over its exact parameter.
  [[nodiscard]] std::unique_ptr<PreparedSearch> prepare_piece(std::size_t piece) const;
  /// Returns the settings of that search, with the time that is left.
  [[nodiscard]] Settings settings_of_piece(const PreparedSearch& preparation) const;
  /// Adds the time and the counts of that search to those of `check`.
  void add(const PreparedSearch& preparation, const Statistics& statistics);

  [[nodiscard]] bool has_ended() const noexcept { return has_ended_; }
  void end(std::size_t piece, Reason reason);
  [[nodiscard]] double seconds_left() const;
  /// True if a search ended because nothing more can be searched.
  [[nodiscard]] bool is_cut_short(const Result& result) const;

 private:
  TrajectoryCheck& check_;
  SearchOptions search_;
  const bool wants_trees_;
  const std::atomic<bool>* const interrupt_;
  Settings settings_;
  bool has_ended_ = false;
};

/// Chooses the engine of searches along way-points. Throws UsageError for options that a motion
/// along way-points does not have.
void settle_options(SearchOptions& search);

/// Returns the check of a request that took `model_seconds` to read. Throws UsageError for options
/// that a motion along way-points does not have.
[[nodiscard]] TrajectoryCheck begin_check(Request request, double model_seconds,
                                          SearchOptions& search);

}  // namespace regulus
