// SPDX-License-Identifier: GPL-3.0-or-later
// A question about a mechanism whose equations have no explicit solution: is one branch of them
// regular all over a motion?
#pragma once

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

struct PreparedClosure {
  Request request;
  ClosedShape shape;
  PreparedSearch preparation;  ///< of the kernel; its labels are those of the request
  MatrixScaling scaling;
  Problem problem;
  BranchStart start;
  BranchPoint near_start;

  [[nodiscard]] ClosureQuestion question() const { return {problem, scaling, shape, near_start}; }
};

/// Forms the kernel of the equations and of their derivatives.
///
/// Requires  request.model.closure.
/// Throws    UsageError for a threshold, and for a start that is not in the motion's ranges; the
///           exceptions of prepare().
[[nodiscard]] PreparedClosure prepare_closure(Request request, double model_seconds,
                                              const SearchOptions& search,
                                              const FormingWatch& watch);

struct ClosureResult {
  BranchResult branch;
  BranchLinks links;

  /// The branch is shown to be one, all over a motion that has a pose.
  [[nodiscard]] bool is_proved() const {
    return branch.is_complete && !branch.is_empty && links.is_one_branch;
  }
};

/// Searches, and links what it finds. `progress` may be null; `ask` as in BranchSettings.
[[nodiscard]] ClosureResult run_closure(
    PreparedClosure& prepared, const SearchOptions& search, const std::atomic<bool>* interrupt,
    Observer* progress, const std::function<bool(const std::vector<double>&)>& ask = {});

}  // namespace regulus
