// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/trajectory_paving.hpp"

#include <algorithm>
#include <new>

#include "codegen/answer/report/paving_options.hpp"
#include "codegen/question/way/path_run.hpp"
#include "codegen/question/way/trajectory_certificate.hpp"
#include "runtime/problem/observers.hpp"
#include "runtime/search/leaf_claims.hpp"

namespace regulus::detail {
namespace {

/// The parts of one piece, as an exhaustive search finds them. Its first variable is s.
class PieceParts final : public Observer {
 public:
  PieceParts(const Problem& problem, std::size_t reach, std::size_t piece)
      : claims_(problem, reach), piece_(piece) {}

  void on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept override {
    add(box, claims_.of(box.box, rule), proof.reason);
  }
  void on_open(const OpenBox& box) noexcept override {
    add(box, Claim::kUndecided, Reason::kTimeBudget);
  }

  /// Returns the parts in their order. Throws std::bad_alloc if some are missing.
  std::vector<PathStretch> take() {
    if (!is_whole_) throw std::bad_alloc();
    std::ranges::sort(parts_, {}, [](const PathStretch& part) { return part.begin.s; });
    return std::move(parts_);
  }

 private:
  void add(const OpenBox& box, Claim claim, Reason reason) noexcept try {
    parts_.push_back({claim, reason, {piece_, box.box[0].lo}, {piece_, box.box[0].hi}});
  } catch (const std::bad_alloc&) {
    is_whole_ = false;
  }

  LeafClaims claims_;
  const std::size_t piece_;
  std::vector<PathStretch> parts_;
  bool is_whole_ = true;
};

class PathPaver {
 public:
  PathPaver(PathPaving& paving, const SearchOptions& search, bool wants_trees,
            const PathWatch& watch)
      : paving_(paving),
        check_(paving.check),
        wants_trees_(wants_trees),
        run_(paving.check, search, wants_trees, watch) {}

  void run() {
    run_.search_all();
    if (check_.path.certified.empty()) return add_rest(0);
    const std::size_t pieces = check_.request.motion.trajectory->pieces.size();
    for (std::size_t k = 0; k < pieces; ++k) {
      if (const auto claim = claim_about(k)) {
        append({*claim, {}, {k, 0}, {k, 1}});
      } else {
        if (must_stop()) {
          check_.can_continue = true;
          return add_rest(k);
        }
        divide(k);
      }
    }
  }

 private:
  [[nodiscard]] bool must_stop() const {
    return run_.has_ended() || run_.seconds_left() <= 0 || run_.is_interrupted();
  }

  /// Returns the claim about a whole piece; nullopt if there is none.
  [[nodiscard]] std::optional<Claim> claim_about(std::size_t k) const {
    if (!check_.path.certified[k]) return std::nullopt;
    const PieceLeaves& leaves = check_.path.leaves[k];
    const int kinds = int(leaves.within) + int(leaves.outside) + int(leaves.out_of_reach);
    if (kinds != 1) return std::nullopt;
    return leaves.within ? Claim::kFree : leaves.outside ? Claim::kOutside : Claim::kUnreachable;
  }

  void divide(std::size_t k) {
    ++check_.searched_alone;
    auto preparation = run_.prepare_piece(k);
    const Problem problem = preparation->problem();
    Settings settings = run_.settings_of_piece(*preparation);
    PavingOptions options;
    options.resolution = paving_.resolution;
    require_paving(options, settings);
    PieceParts parts(problem, preparation->labels.reach, k);
    TreeKept* const tree = wants_trees_ ? &check_.path.trees[k] : nullptr;
    if (tree != nullptr) tree->clear();
    Observers observers(present({&parts, tree}));
    Result result = run_.search_piece(k, *preparation, settings, &observers);
    std::vector<PathStretch> found = parts.take();
    if (found.empty()) found = {{Claim::kUndecided, result.reason, {k, 0}, {k, 1}}};
    for (const PathStretch& part : found) append(part);
    if (result.verdict != Verdict::kSingularity || paving_.singular) return;
    run_.close_in(*preparation, settings, result);
    paving_.singular = DecidingPiece{k, std::move(preparation), std::move(result)};
  }

  /// The pieces that were not reached keep what the common search has shown about them.
  void add_rest(std::size_t first) {
    const std::size_t pieces = check_.request.motion.trajectory->pieces.size();
    for (std::size_t k = first; k < pieces; ++k) {
      const auto claim = check_.path.certified.empty() ? std::nullopt : claim_about(k);
      append({claim.value_or(Claim::kUndecided), reason_to_stop(), {k, 0}, {k, 1}});
    }
  }

  [[nodiscard]] Reason reason_to_stop() const {
    if (run_.has_ended()) return check_.reason;
    return run_.is_interrupted() ? Reason::kInterrupted : Reason::kTimeBudget;
  }

  void append(const PathStretch& part) { append_stretch(paving_.stretches, part); }

  PathPaving& paving_;
  TrajectoryCheck& check_;
  const bool wants_trees_;
  PathRun run_;
};

/// A pose out of reach is no part of the question only if the motion says so.
void set_verdict(PathPaving& paving) {
  TrajectoryCheck& check = paving.check;
  const auto has = [&paving](Claim claim) {
    return std::ranges::find(paving.stretches, claim, &PathStretch::claim) !=
           paving.stretches.end();
  };
  const bool lacks_poses =
      has(Claim::kUnreachable) && check.request.motion.where == Where::kEverywhere;
  check.deciding.reset();
  check.verdict = Verdict::kPossibleProblem;
  if (has(Claim::kSingular)) {
    check.verdict = Verdict::kSingularity;
    check.reason = Reason::kOppositeSigns;
  } else if (has(Claim::kUndecided)) {
    check.reason =
        std::ranges::find(paving.stretches, Claim::kUndecided, &PathStretch::claim)->reason;
  } else if (lacks_poses) {
    check.reason = Reason::kUndefined;
  } else if (!has(Claim::kFree)) {
    check.reason = Reason::kEmptyVariety;
  } else {
    check.verdict = Verdict::kNoSingularity;
    check.reason = Reason::kAllBoxesCertified;
  }
}

}  // namespace

void append_stretch(std::vector<PathStretch>& stretches, const PathStretch& part) {
  if (!stretches.empty() && stretches.back().claim == part.claim)
    stretches.back().end = part.end;
  else
    stretches.push_back(part);
}

double approx_time_at(const Trajectory& trajectory, const PathPlace& place) {
  const TrajectoryPiece& piece = trajectory.pieces[place.piece];
  const double begin = GiNaC::ex_to<GiNaC::numeric>(piece.begin).to_double();
  const double end = GiNaC::ex_to<GiNaC::numeric>(piece.end).to_double();
  return begin + place.s * (end - begin);
}

double approx_share_of(const Trajectory& trajectory, const std::vector<PathStretch>& stretches,
                       Claim claim) {
  const auto time = [&](const PathPlace& place) { return approx_time_at(trajectory, place); };
  double sum = 0;
  for (const PathStretch& stretch : stretches)
    if (stretch.claim == claim) sum += time(stretch.end) - time(stretch.begin);
  return sum / (time({trajectory.pieces.size() - 1, 1}) - time({0, 0}));
}

double PathPaving::approx_share(Claim claim) const {
  return approx_share_of(*check.request.motion.trajectory, stretches, claim);
}

PathPaving pave_trajectory(Request request, double model_seconds, SearchOptions search,
                           double resolution, bool wants_trees, const PathWatch& watch) {
  PathPaving paving;
  paving.resolution = resolution;
  paving.check = begin_check(std::move(request), model_seconds, search);
  PathPaver(paving, search, wants_trees, watch).run();
  set_verdict(paving);
  return paving;
}

ProofStatus certify_path_paving(const std::string& path, PathPaving& paving,
                                const ProofPlacing& placing) {
  TrajectoryCheck& check = paving.check;
  std::swap(check.deciding, paving.singular);
  ProofStatus status = certify_trajectory(path, check, placing);
  std::swap(check.deciding, paving.singular);
  return status;
}

}  // namespace regulus::detail
