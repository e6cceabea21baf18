// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/branch_threshold.hpp"

#include <algorithm>
#include <utility>

#include "codegen/answer/certificate/piece_question.hpp"
#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/question/closure/paving_certificate.hpp"

namespace regulus::detail {
namespace {

/// f is −|det Φ_p|.
ValueAim aim_at(const Request& request) {
  const Interval alpha = enclose_constant(request.motion.alpha, "alpha");
  return {.below = -alpha.hi, .from = -alpha.lo};
}

PiecesRun beside(const PiecesRun& of_branch) {
  return {of_branch.progress, of_branch.topic, of_branch.kept.named("determinants")};
}

PlaceBelow place_below(const PiecesOfBranch& pieces, std::size_t piece, const BranchTube& tube,
                       std::vector<Interval> place) {
  ValuesAtPlace at = values_at(pieces, piece, tube, place, nullptr);
  return {piece, std::move(place), std::move(at.unknowns), at.determinant};
}

}  // namespace

BranchValue value_at_threshold(const Model& model) {
  Component determinant;
  determinant.kind = QuantityKind::kDeterminant;
  return {model, determinant};
}

SearchTopic topic_of_branch(SearchTopic topic, const Request& request) {
  if (has_threshold(request)) topic.kind = TopicKind::kBranch;
  return topic;
}

ThresholdFinding compare_threshold(const PiecesOfBranch& pieces, const BoxSearchSettings& settings,
                                   const PiecesRun& run) {
  const ValueAim aim = aim_at(pieces.request());
  BracketOfPieces values = bracket_values(pieces, value_at_threshold(pieces.common.request.model),
                                          aim, settings, beside(run));
  ThresholdFinding found;
  found.boxes = values.boxes;
  found.seconds = values.seconds;
  if (values.attained >= *aim.from) {
    found.verdict = Verdict::kSingularity;
    found.below = place_below(pieces, values.piece, *values.place, std::move(values.at));
  } else if (values.upper < *aim.below) {
    found.verdict = Verdict::kNoSingularity;
    found.trees = std::move(values.trees);
  } else {
    found.stopped_by = values.stopped_by;
    found.reason = values.stopped_by ? describe(*values.stopped_by)
                                     : "|det| is too near alpha, or boxes at the least width are "
                                       "too wide to decide";
  }
  return found;
}

ThresholdFinding pave_threshold(const PiecesOfBranch& pieces, double resolution,
                                const BoxSearchSettings& settings, const PiecesRun& run) {
  const ValueAim aim = aim_at(pieces.request());
  const bool is_whole = std::ranges::none_of(pieces.results, [](const ClosureResult& piece) {
    return piece.branch.stopped_by || piece.links.stopped_by;
  });
  ThresholdFinding found;
  found.paved = pave_pieces(pieces, value_at_threshold(pieces.common.request.model), aim,
                            resolution, is_whole, settings, beside(run),
                            [](std::size_t, std::span<const Interval>, ForceClaim) {});
  for (std::size_t k = 0; k < found.paved.size(); ++k) {
    BranchPaving& piece = found.paved[k];
    if (piece.place && !found.below)
      found.below = place_below(pieces, k, *piece.place, std::move(piece.at));
    if (!found.stopped_by) found.stopped_by = piece.stopped_by;
    found.boxes += piece.boxes;
    found.seconds += piece.seconds;
  }
  if (found.below)
    found.verdict = Verdict::kSingularity;
  else if (std::ranges::all_of(pieces.results, &ClosureResult::is_proved) &&
           found.paved.size() == pieces.count() &&
           std::ranges::all_of(found.paved, &BranchPaving::is_feasible))
    found.verdict = Verdict::kNoSingularity;
  else
    found.reason = describe(found.stopped_by.value_or(Reason::kWidth));
  return found;
}

void conclude(Result& result, const ThresholdFinding& found) {
  result.statistics.boxes += found.boxes;
  if (!result.stopped_by) result.stopped_by = found.stopped_by;
  const bool is_followed = result.verdict == Verdict::kNoSingularity;
  if (found.verdict == Verdict::kSingularity && result.verdict != Verdict::kSingularity) {
    result.verdict = Verdict::kSingularity;
    result.reason = Reason::kSmallDeterminant;
    result.blocking_box.clear();
  } else if (is_followed && found.verdict == Verdict::kPossibleProblem) {
    result.verdict = Verdict::kPossibleProblem;
    result.reason = found.stopped_by.value_or(Reason::kWidth);
  }
}

ProofStatus certify_threshold(const std::string& path, const PiecesOfBranch& pieces,
                              const ThresholdFinding& found, const ProofPlacing& placing) {
  if (found.paved.empty()) {
    if (found.verdict == Verdict::kPossibleProblem) {
      ProofStatus status(path);
      if (status.is_wanted()) status.set_obstacle(kNothingClaimed);
      return status;
    }
    if (found.below)
      return certify_exceeded(path, pieces.proved(),
                              PlaceOfValue{found.below->piece, found.below->place}, placing);
    return certify_exceeded(path, pieces.proved(found.trees), std::nullopt, placing);
  }
  if (found.verdict == Verdict::kNoSingularity) {
    ProvedPieces proved = pieces.proved();
    proved.trees.clear();
    for (const BranchPaving& piece : found.paved) proved.trees.push_back(&piece.tree);
    return certify_exceeded(path, proved, std::nullopt, placing);
  }
  std::vector<PavedTree> trees;
  for (const BranchPaving& piece : found.paved) trees.push_back({&piece.tree, piece.words, true});
  trees.resize(pieces.count());
  return certify_paved(path, pieces.request(), pieces.common.preparation.labels, trees,
                       is_regular(), placing);
}

}  // namespace regulus::detail
