// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/load/way_force_paving.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "codegen/model/way/trajectory.hpp"
#include "codegen/question/load/feasibility_report.hpp"
#include "codegen/question/load/way_force_stage.hpp"
#include "codegen/question/way/path_run.hpp"

namespace regulus::detail {
namespace {

class WayForcePaver {
 public:
  WayForcePaver(WayForcePaving& paving, const std::string& load, const SearchOptions& search,
                bool wants_trees, const PathWatch& watch)
      : paving_(paving),
        found_(paving.found),
        wants_trees_(wants_trees),
        stage_(paving.found, load, search, wants_trees, watch) {}

  void run(double model_seconds) {
    stage_.search_all(model_seconds);
    for (std::size_t k = 0; k < stage_.pieces().size(); ++k) pave(k);
    conclude();
  }

 private:
  /// A search of all pieces that was stopped says nothing about those that it did not reach.
  void pave(std::size_t k) {
    const PieceForces& piece = stage_.pieces()[k];
    const bool is_one_claim = piece.is_held && piece.is_within != piece.is_outside;
    if (is_one_claim && !stage_.has_ended())
      append({piece.is_within ? ForceClaim::kFeasible : ForceClaim::kOutside, {k, 0}, {k, 1}});
    else if (stage_.must_stop(k))
      append({ForceClaim::kUndecided, {k, 0}, {k, 1}});
    else
      divide(k);
  }

  /// The first variable of a piece is s, and no other is halved.
  void divide(std::size_t k) {
    std::vector<ForceStretch> parts;
    const auto listen = [&](std::span<const Interval> box, ForceClaim claim) {
      parts.push_back({claim, {k, box[0].lo}, {k, box[0].hi}});
    };
    TreeKept* const tree = wants_trees_ ? &found_.trees[k] : nullptr;
    if (tree != nullptr) tree->clear();
    auto [prepared, result] = stage_.search_piece(k, paving_.resolution, listen, tree);
    std::ranges::sort(parts, {}, [](const ForceStretch& part) { return part.begin.s; });
    for (const ForceStretch& part : parts) append(part);
    if (parts.empty()) append({ForceClaim::kUndecided, {k, 0}, {k, 1}});
    const bool is_infeasible = result.verdict == FeasibilityVerdict::kInfeasible;
    const bool has_answer = result.verdict == FeasibilityVerdict::kFeasible || result.is_empty;
    const bool decides = is_infeasible && found_.verdict != FeasibilityVerdict::kInfeasible;
    if (has_answer || (found_.deciding && !decides)) return;
    found_.verdict = result.verdict;
    found_.reason = result.reason;
    found_.deciding.emplace(DecidingForces{k, std::move(prepared), std::move(result)});
  }

  void append(const ForceStretch& part) {
    auto& all = paving_.stretches;
    if (!all.empty() && all.back().claim == part.claim)
      all.back().end = part.end;
    else
      all.push_back(part);
  }

  [[nodiscard]] bool has(ForceClaim claim) const {
    return std::ranges::find(paving_.stretches, claim, &ForceStretch::claim) !=
           paving_.stretches.end();
  }

  void conclude() {
    if (found_.deciding) return;
    if (!has(ForceClaim::kFeasible))
      found_.reason = Reason::kEmptyVariety;
    else if (!has(ForceClaim::kUndecided) && !has(ForceClaim::kInfeasible))
      found_.verdict = FeasibilityVerdict::kFeasible;
  }

  WayForcePaving& paving_;
  WayForces& found_;
  const bool wants_trees_;
  WayForceStage stage_;
};

const Trajectory& trajectory_of(const WayForcePaving& paving) {
  return *paving.found.request.motion.trajectory;
}

}  // namespace

WayForcePaving pave_forces_along_way(Request request, double model_seconds, const std::string& load,
                                     SearchOptions search, double resolution, bool wants_trees,
                                     const PathWatch& watch) {
  settle_options(search);
  WayForcePaving paving;
  paving.resolution = resolution;
  paving.found.request = std::move(request);
  paving.found.request.motion.alpha = 0;
  WayForcePaver(paving, load, search, wants_trees, watch).run(model_seconds);
  return paving;
}

std::vector<PathStretch> as_path_stretches(const WayForcePaving& paving) {
  std::vector<PathStretch> stretches;
  for (const ForceStretch& stretch : paving.stretches)
    stretches.push_back({stand_in(stretch.claim), {}, stretch.begin, stretch.end});
  return stretches;
}

double WayForcePaving::approx_share(ForceClaim claim) const {
  return approx_share_of(*found.request.motion.trajectory, as_path_stretches(*this),
                         stand_in(claim));
}

void tell_force_stretches(const Trajectory& trajectory, double resolution,
                          const std::vector<PathStretch>& stretches, Facts& facts) {
  std::vector<Claim> claims;
  for (const ForceClaim claim : kEveryForceClaim) claims.push_back(stand_in(claim));
  facts.add("resolution", resolution);
  tell_stretches(trajectory, stretches, claims, word_of_stand_in, facts);
}

void tell_way_force_paving(const WayForcePaving& paving, Facts& facts) {
  tell_way_forces(paving.found, facts);
  tell_force_stretches(trajectory_of(paving), paving.resolution, as_path_stretches(paving), facts);
}

}  // namespace regulus::detail
