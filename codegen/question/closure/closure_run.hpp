// SPDX-License-Identifier: GPL-3.0-or-later
// A question about a mechanism whose equations have no explicit solution: is one branch of them
// regular all over a motion?
#pragma once

#include <chrono>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "codegen/question/closure/branch_links.hpp"
#include "codegen/question/engine/pipeline.hpp"

namespace regulus {

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
/// Throws    UsageError for a threshold; the exceptions of prepare().
[[nodiscard]] PreparedSystem prepare_system(Request request, double model_seconds,
                                            const SearchOptions& search, const FormingWatch& watch,
                                            DerivativesBy by = DerivativesBy::kVariables,
                                            const std::vector<PoseParameter>& constants = {});

/// Encloses where the values of each unknown may be.
[[nodiscard]] std::vector<Interval> enclose_ranges(const Closure& closure);

struct PreparedClosure : PreparedSystem {
  BranchStart start;
  BranchPoint near_start;
  std::vector<Interval> ranges;  ///< by unknown: where its values may be

  [[nodiscard]] ClosureQuestion question() const {
    return {problem, scaling, shape, near_start, ranges};
  }
};

/// Forms the kernel of the equations and of their derivatives. `constants`: as for close().
///
/// Requires  request.model.closure.
/// Throws    UsageError for a threshold, and for a start that is not in the motion's ranges; the
///           exceptions of prepare().
[[nodiscard]] PreparedClosure prepare_closure(Request request, double model_seconds,
                                              const SearchOptions& search,
                                              const FormingWatch& watch,
                                              DerivativesBy by = DerivativesBy::kVariables,
                                              const std::vector<PoseParameter>& constants = {});

struct ClosureResult {
  BranchResult branch;
  BranchLinks links;

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

/// The search has this part of the time; the links have the rest.
inline constexpr double kPartOfSearch = 0.9;

/// Runs the search with these settings, and keeps it in a file, for the option --checkpoint.
using SearchOfBranch = std::function<BranchResult(const BranchSettings&)>;
using KeepBranch = std::function<BranchResult(const BranchSettings&, const SearchOfBranch&)>;

/// Searches, and links what it finds, if the search is complete or paves. `progress` may be null.
/// `keep`: empty means that no file has the search.
[[nodiscard]] ClosureResult run_closure(PreparedClosure& prepared, const BranchSettings& settings,
                                        Observer* progress, const KeepBranch& keep = {});

/// Returns everything that the boxes depend on, for a checkpoint.
[[nodiscard]] nlohmann::ordered_json checkpointed_question(const PreparedClosure& prepared,
                                                           const SearchOptions& search,
                                                           const BranchSettings& settings);

}  // namespace regulus
