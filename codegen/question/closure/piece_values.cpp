// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/piece_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "codegen/model/way/trajectory.hpp"
#include "codegen/question/closure/excluded_tubes.hpp"
#include "codegen/question/closure/uncertain_values.hpp"
#include "codegen/question/way/trajectory_run.hpp"
#include "runtime/interval/floating_point_scope.hpp"

namespace regulus::detail {
namespace {

/// The tubes of a way must also join its pieces.
void drop_excluded(const PiecesOfBranch& pieces, std::size_t piece, BranchTree& tree) {
  if (!pieces.request().motion.trajectory)
    drop_excluded_tubes(tree, pieces.problem_of(piece).outer);
}

void add(BracketOfPieces& all, ValueBracket found, std::size_t piece) {
  all.upper = piece == 0 ? found.upper : std::fmax(all.upper, found.upper);
  if (found.place) {
    all.attained = found.attained;
    all.piece = piece;
    all.place = std::move(found.place);
    all.at = std::move(found.at);
  }
  if (!all.stopped_by) all.stopped_by = found.stopped_by;
  all.boxes += found.boxes;
  all.seconds += found.seconds;
  all.trees.push_back(std::move(found.tree));
}

/// Returns the settings of the next of so many pieces, which has its share of what is left.
BoxSearchSettings share_of(const BoxSearchSettings& all, std::uint64_t spent_boxes,
                           double spent_seconds, std::size_t pieces) {
  if (pieces == 1 && spent_boxes == 0) return all;
  BoxSearchSettings share = all;
  share.time_limit = std::fmax(0.0, all.time_limit - spent_seconds) / double(pieces);
  share.max_boxes = (all.max_boxes - std::min(all.max_boxes, spent_boxes)) / pieces;
  return share;
}

}  // namespace

ProvedPieces PiecesOfBranch::proved(const std::vector<BranchTree>& trees) const {
  ProvedPieces proved{request(), common.preparation.labels, {}};
  for (const BranchTree& tree : trees) proved.trees.push_back(&tree);
  return proved;
}

ProvedPieces PiecesOfBranch::proved() const {
  ProvedPieces proved{request(), common.preparation.labels, {}};
  for (const ClosureResult& piece : results) proved.trees.push_back(&piece.branch.tree);
  return proved;
}

void PiecesOfBranch::turn_to_piece(cluster::Workers* workers, SearchTopic topic,
                                   std::size_t piece) const {
  const Motion& motion = request().motion;
  if (!motion.trajectory) return turn_to(workers, std::move(topic), motion);
  topic.start = begins[piece].unknowns;
  detail::turn_to_piece(workers, std::move(topic), motion, piece);
}

std::string PiecesOfBranch::part_of_name(std::size_t piece) const {
  return request().motion.trajectory ? place_of_piece(piece) : "";
}

QuestionOfPiece::QuestionOfPiece(const PiecesOfBranch& pieces, std::size_t piece)
    : problem(pieces.problem_of(piece)),
      closure{problem, pieces.common.scaling, pieces.common.shape, pieces.begins[piece],
              pieces.common.ranges},
      system(problem, pieces.common.scaling, pieces.common.shape),
      is_possible([this, &common = pieces.common](const std::vector<Interval>& point) {
        return is_in_motion(common, system, point);
      }) {}

/// A value that one piece attains ends the searches of later pieces earlier. So the file names it beside
/// the piece: a search goes on only from one that knew the same value.
BracketOfPieces bracket_values(const PiecesOfBranch& pieces, const BranchValue& value, ValueAim aim,
                               const BoxSearchSettings& settings, const PiecesRun& run) {
  BracketOfPieces all;
  for (std::size_t k = 0; k < pieces.count(); ++k) {
    QuestionOfPiece piece(pieces, k);
    aim.attained = all.attained;
    pieces.turn_to_piece(settings.workers, run.topic, k);
    const auto search = [&](const BoxSearchSettings& chosen) {
      return search_value({piece.problem, piece.closure, value}, pieces.results[k].branch.tree, aim,
                          chosen, piece.is_possible, run.progress);
    };
    const std::string after = k == 0 ? "" : fmt::format(" after {:a}", aim.attained);
    add(all,
        run.kept.run(share_of(settings, all.boxes, all.seconds, pieces.count() - k), search,
                     pieces.part_of_name(k) + after),
        k);
    if (aim.from && all.attained >= *aim.from) break;
  }
  for (std::size_t k = 0; k < all.trees.size(); ++k) drop_excluded(pieces, k, all.trees[k]);
  if (all.trees.size() < pieces.count()) all.upper = kInfinity;
  all.is_closed = aim.is_met(all.attained, all.upper);
  if (all.is_closed) all.stopped_by.reset();
  return all;
}

std::vector<BranchPaving> pave_pieces(const PiecesOfBranch& pieces, const BranchValue& value,
                                      const ValueAim& aim, double resolution, bool is_whole,
                                      const BoxSearchSettings& settings, const PiecesRun& run,
                                      const PieceForceListener& listener) {
  std::vector<BranchPaving> paved;
  std::uint64_t boxes = 0;
  double seconds = 0;
  for (std::size_t k = 0; k < pieces.results.size(); ++k) {
    QuestionOfPiece piece(pieces, k);
    const ForceListener listen = [&](std::span<const Interval> box, ForceClaim claim) {
      listener(k, box, claim);
    };
    pieces.turn_to_piece(settings.workers, run.topic, k);
    const auto search = [&](const BoxSearchSettings& chosen) {
      return pave_values({piece.problem, piece.closure, value}, pieces.results[k], aim, resolution,
                         chosen, piece.is_possible, listen, run.progress);
    };
    const BoxSearchSettings share = share_of(settings, boxes, seconds, pieces.results.size() - k);
    BranchPaving& found = paved.emplace_back(
        is_whole ? run.kept.run(share, search, pieces.part_of_name(k)) : search(share));
    drop_excluded(pieces, k, found.tree);
    found.name_excluded();
    boxes += found.boxes;
    seconds += found.seconds;
  }
  return paved;
}

ValuesAtPlace values_at(const PiecesOfBranch& pieces, std::size_t piece, const BranchTube& tube,
                        const std::vector<Interval>& place, const BranchValue* value) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  const PreparedClosure& closure = pieces.common;
  const Problem problem = pieces.problem_of(piece);
  SystemBoxes system(problem, closure.scaling, closure.shape);
  TubeFinder finder(system, closure.shape, closure.ranges);
  const TubeTrial trial{place, tube, {}};
  const auto measured = finder.measure({&trial, 1});
  ValuesAtPlace at{enclose(tube, place)};
  if (!measured.front()) return at;
  const BranchRates rates(tube, measured.front()->image, measured.front()->inverse,
                          measured.front()->over.by_unknown);
  at.determinant = rates.determinant();
  if (value != nullptr) at.beyond = value->farthest_beyond(rates, measured.front()->over);
  return at;
}

}  // namespace regulus::detail
