// SPDX-License-Identifier: GPL-3.0-or-later
// Searches of a value over a branch in pieces, which was followed or paved before: a motion along
// way-points has a piece for each segment, one over ranges is a piece.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "codegen/question/closure/closure_way.hpp"
#include "codegen/question/closure/value_certificate.hpp"
#include "codegen/question/closure/value_paving.hpp"
#include "codegen/question/closure/value_search.hpp"

namespace regulus::detail {

/// The pieces that were followed or paved. It refers to what it is made of.
struct PiecesOfBranch {
  const PreparedClosure& common;
  const PreparedWay* way = nullptr;  ///< null: over ranges
  std::span<const BranchPoint> begins;
  std::span<const ClosureResult> results;

  [[nodiscard]] const Request& request() const {
    return way != nullptr ? way->request : common.request;
  }
  [[nodiscard]] std::size_t count() const { return way != nullptr ? way->pieces() : 1; }
  [[nodiscard]] Problem problem_of(std::size_t piece) const {
    return way != nullptr ? way->problem_of(piece) : common.problem;
  }
  /// Returns what certificates are about: these trees, of all pieces.
  [[nodiscard]] ProvedPieces proved(const std::vector<BranchTree>& trees) const;
  /// The same with the trees of the branch.
  [[nodiscard]] ProvedPieces proved() const;
  /// Tells other processes that the next search is about this piece.
  void turn_to_piece(cluster::Workers* workers, SearchTopic topic, std::size_t piece) const;
  /// Returns what a file calls the search of this piece, after its name: nothing over ranges.
  [[nodiscard]] std::string part_of_name(std::size_t piece) const;
};

/// Returns a branch over ranges as one piece, which refers to both.
[[nodiscard]] inline PiecesOfBranch pieces_of(const PreparedClosure& prepared,
                                              const ClosureResult& searched) {
  return {prepared, nullptr, {&prepared.near_start, 1}, {&searched, 1}};
}
/// Returns a branch along way-points, which refers to both.
[[nodiscard]] inline PiecesOfBranch pieces_of(const PreparedWay& prepared,
                                              const WayFinding& found) {
  return {prepared.common, &prepared, found.begins, found.pieces};
}

/// The question about one piece, for searches of values.
///
/// Requires  pieces that outlive this, and were reached.
struct QuestionOfPiece {
  QuestionOfPiece(const PiecesOfBranch& pieces, std::size_t piece);
  QuestionOfPiece(const QuestionOfPiece&) = delete;
  QuestionOfPiece& operator=(const QuestionOfPiece&) = delete;

  const Problem problem;
  const ClosureQuestion closure;
  SystemBoxes system;
  const IsPossible is_possible;
};

/// The largest value over all pieces.
struct BracketOfPieces {
  double attained = -kInfinity, upper = kInfinity;  ///< of f, rounded outward
  std::size_t piece = 0;                            ///< that has `place`
  std::optional<BranchTube>
      place{};                 ///< over the place where `attained` is, as ValueBracket::place
  std::vector<Interval> at{};  ///< that place, by variable
  bool is_closed = false;
  std::optional<Reason> stopped_by{};
  std::uint64_t boxes = 0;
  double seconds = 0;
  std::vector<BranchTree> trees{};  ///< of the pieces that were searched
};

/// Brackets the largest f piece by piece, or compares it with a limit: what one piece attains is known
/// to the next ones. With several pieces each has its share of the limits that are left.
///
/// Requires  the branch is proved.
/// Throws    the exceptions of the workers.
[[nodiscard]] BracketOfPieces bracket_values(const PiecesOfBranch& pieces, const BranchValue& value,
                                             ValueAim aim, const BoxSearchSettings& settings,
                                             const PiecesRun& run);

/// Receives the claim about a box of a piece.
using PieceForceListener =
    std::function<void(std::size_t piece, std::span<const Interval> box, ForceClaim claim)>;

/// Paves the pieces that were reached: pave_values(). `is_whole`: another run has the same branch, so that
/// the file may have the search over it.
[[nodiscard]] std::vector<BranchPaving> pave_pieces(const PiecesOfBranch& pieces,
                                                    const BranchValue& value, const ValueAim& aim,
                                                    double resolution, bool is_whole,
                                                    const BoxSearchSettings& settings,
                                                    const PiecesRun& run,
                                                    const PieceForceListener& listener);

/// The values that a search finds over a place of a piece.
struct ValuesAtPlace {
  std::vector<Interval> unknowns;               ///< encloses the configuration
  Interval determinant{-kInfinity, kInfinity};  ///< of Φ_p
  std::optional<ForceBeyond> beyond{};          ///< of a load within limits
};

/// Returns the numbers of a place for people. `value`: of a load within limits; null: no forces.
[[nodiscard]] ValuesAtPlace values_at(const PiecesOfBranch& pieces, std::size_t piece,
                                      const BranchTube& tube, const std::vector<Interval>& place,
                                      const BranchValue* value);

}  // namespace regulus::detail
