// SPDX-License-Identifier: GPL-3.0-or-later
// The first stage of every question about a trajectory: one search of all its pieces.
#pragma once

#include <atomic>

#include "codegen/question/engine/options.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/way/trajectory_run.hpp"

namespace regulus::detail {

class PathRun {
 public:
  /// `watch`: its display may be null. Requires  `check` has its request, and lives as long as this.
  PathRun(TrajectoryCheck& check, const SearchOptions& search, bool wants_trees,
          const PathWatch& watch);

  /// Prepares the kernel of all pieces and searches them. If that is stopped, the reason and the
  /// piece are in `check`, and has_ended() is true. Throws as `prepare`.
  void search_all();

  /// Prepares the search of one piece over its exact parameter.
  [[nodiscard]] std::unique_ptr<PreparedSearch> prepare_piece(std::size_t piece) const;
  /// Returns the settings of that search, with the time that is left.
  [[nodiscard]] Settings settings_of_piece(const PreparedSearch& preparation) const;
  /// Runs it, with an observer that may be null, and adds its time and counts to those of `check`.
  [[nodiscard]] Result search_piece(std::size_t piece, PreparedSearch& preparation,
                                    const Settings& settings, Observer* observer);

  /// Refines its witness.
  void close_in(PreparedSearch& preparation, const Settings& settings, Result& result) const {
    close_in_on_witness(preparation, search_, settings, result);
  }

  [[nodiscard]] bool has_ended() const noexcept { return has_ended_; }
  void end(std::size_t piece, Reason reason);
  [[nodiscard]] bool is_interrupted() const { return watch_.is_interrupted(); }
  [[nodiscard]] double seconds_left() const;
  /// True if a search ended because nothing more can be searched.
  [[nodiscard]] bool is_cut_short(const Result& result) const;

 private:
  void add(const PreparedSearch& preparation, const Statistics& statistics);

  TrajectoryCheck& check_;
  SearchOptions search_;
  const bool wants_trees_;
  const PathWatch watch_;
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

}  // namespace regulus::detail
