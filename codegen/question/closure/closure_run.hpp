// SPDX-License-Identifier: GPL-3.0-or-later
// A question about a mechanism whose equations have no explicit solution: is one branch of them
// regular all over a motion?
#pragma once

#include <chrono>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "codegen/answer/report/json_checkpoint.hpp"
#include "codegen/question/closure/branch_links.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/engine/search_topic.hpp"

namespace regulus::detail {

/// Reads the model if it has a [closure]; nullopt if it has none.
///
/// Throws    as read_request().
[[nodiscard]] std::optional<Request> read_closure(const ModelOptions& options,
                                                  const FormingWatch& watch);

/// The equations of a closure with the kernel of them and of their derivatives.
struct PreparedSystem {
  Request request;
  ClosedShape shape;
  PreparedSearch preparation;  ///< of the kernel; its labels are those of the request
  MatrixScaling scaling;
  Problem problem;
};

/// Forms the kernel. `constants`: as for close().
///
/// Requires  request.model.closure.
/// Throws    the exceptions of prepare().
[[nodiscard]] PreparedSystem prepare_system(Request request, double model_seconds,
                                            const SearchOptions& search, const FormingWatch& watch,
                                            DerivativesBy by = DerivativesBy::kVariables,
                                            const std::vector<PoseParameter>& constants = {});

/// Encloses where the values of each unknown may be.
[[nodiscard]] std::vector<Interval> enclose_ranges(const Closure& closure);

struct PreparedClosure : PreparedSystem {
  BranchStart start;
  BranchPoint near_start;
  std::vector<Interval> ranges;     ///< by unknown: where its values may be
  std::string obstacle_of_start{};  ///< why no branch is known to begin there; empty if one does

  [[nodiscard]] ClosureQuestion question() const {
    return {problem, scaling, shape, near_start, ranges};
  }
};

/// Forms the kernel of the equations and of their derivatives. `constants`: as for close().
///
/// Requires  request.model.closure.
/// Throws    UsageError for a start that is not in the motion's ranges; the exceptions of prepare().
[[nodiscard]] PreparedClosure prepare_closure(Request request, double model_seconds,
                                              const SearchOptions& search,
                                              const FormingWatch& watch,
                                              DerivativesBy by = DerivativesBy::kVariables,
                                              const std::vector<PoseParameter>& constants = {});

/// Takes a smaller radius of the start in the place of a usual one, if exactly one configuration is shown
/// to be within that alone. Notes why there is none. `problem`: of the place of the start.
void fit_start(PreparedClosure& prepared, const Problem& problem);

struct ClosureResult {
  BranchResult branch;
  BranchLinks links;
  bool has_start = true;  ///< false: nothing was searched, because no branch is known to begin

  /// The branch is shown to be one, all over a motion that has a pose.
  [[nodiscard]] bool is_proved() const {
    return branch.is_complete && !branch.is_empty && links.is_one_branch;
  }
};

/// Returns the settings of a search with the limits of the options that are left.
[[nodiscard]] BranchSettings settings_of(const PreparedSystem& prepared,
                                         const SearchOptions& search,
                                         const std::atomic<bool>* interrupt);

/// The end of the time of a search, which starts now.
class Deadline {
 public:
  explicit Deadline(const BranchSettings& settings)
      : limit_(settings.time_limit), interrupt_(settings.interrupt) {}

  [[nodiscard]] double left() const {
    return limit_ - std::chrono::duration<double>(Clock::now() - start_).count();
  }
  [[nodiscard]] std::optional<Reason> reason() const {
    if (interrupt_ != nullptr && *interrupt_) return Reason::kInterrupted;
    return left() <= 0 ? std::optional(Reason::kTimeBudget) : std::nullopt;
  }

 private:
  using Clock = std::chrono::steady_clock;

  const Clock::time_point start_ = Clock::now();
  const double limit_;
  const std::atomic<bool>* const interrupt_;
};

/// Returns the settings of a search after that of a branch, which has evaluated so many boxes.
[[nodiscard]] BoxSearchSettings rest_of(const BranchSettings& settings, const Deadline& deadline,
                                        std::uint64_t spent_boxes);

/// The search has this part of the time; the links have the rest.
inline constexpr double kPartOfSearch = 0.9;

/// The file that has searches of a branch, for the option --checkpoint.
struct KeptPieces {
  JsonCheckpoint* file = nullptr;  ///< null: none
  /// Seconds between two saves, at most; nullopt: the usual ones.
  std::optional<double> interval{};
  std::string name{};  ///< of the searches in the file

  /// Runs a search with its place in the file, if there is one. `part`: of the name of the place.
  template <class BoxSettings, class Search>
  auto run(BoxSettings settings, const Search& search, const std::string& part = "") const {
    if (file == nullptr) return search(settings);
    if (interval) settings.save_every = *interval;
    const bool has_both = !name.empty() && !part.empty();
    return file->continue_search(settings, search, name + (has_both ? ", " : "") + part);
  }
  /// Returns the same file for other searches.
  [[nodiscard]] KeptPieces named(std::string other) const {
    return {file, interval, std::move(other)};
  }
};

/// How the searches of a branch, or of all its pieces, are watched, shared and kept.
struct PiecesRun {
  Observer* progress = nullptr;  ///< may be null
  SearchTopic topic{};           ///< for other processes, without what tells one piece from another
  KeptPieces kept{};
};

/// Returns that nothing is known, because of PreparedClosure::obstacle_of_start.
[[nodiscard]] ClosureResult without_start(const PreparedClosure& prepared,
                                          const ClosureQuestion& question,
                                          const BranchSettings& settings, Observer* progress);

/// Searches, and links what it finds, if the search is complete or paves. `progress` may be null.
[[nodiscard]] ClosureResult run_closure(PreparedClosure& prepared, const BranchSettings& settings,
                                        Observer* progress, const KeptPieces& kept = {});

/// Returns everything that the boxes depend on, for a checkpoint. `resolution`: of a paving; 0: of a check.
[[nodiscard]] nlohmann::ordered_json checkpointed_question(const PreparedClosure& prepared,
                                                           const SearchOptions& search,
                                                           double resolution);

}  // namespace regulus::detail
