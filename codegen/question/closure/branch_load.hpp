// SPDX-License-Identifier: GPL-3.0-or-later
// Do the motors of a closure hold a load within their limits, over one branch, and where? The force
// of a motor is that of its equilibrium with the load: branch_value.hpp.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "codegen/answer/report/output_options.hpp"
#include "codegen/answer/report/search_checkpoint.hpp"
#include "codegen/question/closure/branch_pieces.hpp"
#include "codegen/question/closure/branch_value.hpp"
#include "codegen/question/closure/value_paving.hpp"
#include "codegen/question/load/feasibility_report.hpp"

namespace regulus::detail {

/// A question that is ready to be searched.
struct PreparedBranchLoad {
  BranchInPieces branch;  ///< with the derivatives by the motors
  SearchOptions search;
  std::string load;  ///< name
  std::string force_unit;
  std::vector<Interval> limits;  ///< by motor: forces in them are certainly within

  [[nodiscard]] const PreparedClosure& closure() const { return branch.common(); }
  [[nodiscard]] const VectorSet& set() const { return choose_load(closure().request.model, load); }
  [[nodiscard]] BranchValue value() const { return {closure().request.model, set()}; }
  [[nodiscard]] LoadWords words() const {
    return {closure().preparation, load, force_unit, limits};
  }
};

/// Forms the kernel.
///
/// Requires  request.model.closure.
/// Throws    UsageError if there is no such load or no limits; the exceptions of prepare_closure().
[[nodiscard]] PreparedBranchLoad prepare_branch_load(const Request& request, double model_seconds,
                                                     const std::string& load,
                                                     const SearchOptions& search,
                                                     const FormingWatch& watch);

/// A force that is beyond its limits at one place, and is that of the load alone.
struct BranchShortage {
  std::size_t piece = 0;
  std::vector<Interval> place;     ///< by variable
  std::vector<Interval> unknowns;  ///< encloses the configuration
  ForceBeyond beyond;
};

struct BranchLoadResult {
  FeasibilityVerdict verdict = FeasibilityVerdict::kPossibleProblem;
  std::string reason;                 ///< why neither was shown; otherwise empty
  std::vector<BranchTree> trees;      ///< of FEASIBLE: the load is held over each tube
  std::vector<BranchPaving> paved{};  ///< of a paving: the pieces that were reached
  std::optional<BranchShortage> shortage{};
  bool is_empty = false;
  std::optional<Reason> stopped_by{};
  std::uint64_t boxes = 0;
};

/// The display, the interrupt and the file of a search.
struct BranchLoadRun {
  OutputOptions output;
  const std::atomic<bool>* interrupt = nullptr;
  SearchCheckpoint* checkpoint = nullptr;  ///< of both searches; null: none
};

/// Shows the branch, over ranges or along way-points, and then that every force is within its limits,
/// or that some force is not.
///
/// Ensures   kInfeasible: at `shortage` a force is beyond its limits, for some wrench of the load.
[[nodiscard]] BranchLoadResult check_branch_load(PreparedBranchLoad& prepared,
                                                 const BranchLoadRun& run);

/// Writes the proof of a check. An empty `path` means no certificate.
[[nodiscard]] ProofStatus certify_load(const std::string& path, const PreparedBranchLoad& prepared,
                                       const BranchLoadResult& result, const ProofPlacing& placing);

/// Writes the proof of a paving: what is claimed of each of its boxes. An empty `path` means no certificate.
[[nodiscard]] ProofStatus certify_load_paving(const std::string& path,
                                              const PreparedBranchLoad& prepared,
                                              const BranchLoadResult& result,
                                              const ProofPlacing& placing);

/// Decides every box of the pieces, down to so small a part of each range, as far as the branch is
/// followed. `listener` receives every leaf, in one order; `progress` may be null, and gets them as of
/// search_forces().
[[nodiscard]] BranchLoadResult pave_branch_load(PreparedBranchLoad& prepared, double resolution,
                                                const BranchLoadRun& run,
                                                const PieceForceListener& listener,
                                                Observer* progress);

/// Returns everything that the boxes depend on, for a checkpoint. `resolution`: of a paving.
[[nodiscard]] nlohmann::ordered_json checkpointed_question(const PreparedBranchLoad& prepared,
                                                           std::optional<double> resolution);

/// Returns the claim of FEASIBLE.
[[nodiscard]] std::string claim_of(const PreparedBranchLoad& prepared);

/// Tells the question, the claim, the place where it fails and, along way-points, where the branch ends;
/// `volumes`: of a paving over ranges, or null.
void tell_branch_load(const PreparedBranchLoad& prepared, const BranchLoadResult& result,
                      const ForceVolumes* volumes, Facts& facts);

}  // namespace regulus::detail
