// SPDX-License-Identifier: GPL-3.0-or-later
// A motion of a closure along way-points: one branch is followed through all pieces.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "codegen/question/closure/closure_report.hpp"

namespace regulus::detail {

/// The kernel of all pieces: their numbers are its constants.
struct PreparedWay {
  Request request;  ///< with the trajectory
  PreparedClosure
      common;  ///< of s, the uncertain quantities and the errors; it begins at the start
  std::vector<std::vector<Interval>> values;  ///< by piece, of each constant

  [[nodiscard]] std::size_t pieces() const noexcept { return values.size(); }
  /// Returns the problem of a piece.
  [[nodiscard]] Problem problem_of(std::size_t piece) const;
  /// Encloses the commanded value of each pose parameter on a part of a segment.
  [[nodiscard]] std::vector<Interval> commanded(std::size_t piece, const Interval& s) const;
  /// Returns "theta = 0.3 rad": the commanded pose on a segment, about.
  [[nodiscard]] std::string pose_at(std::size_t piece, const Interval& s) const;
};

/// Throws    UsageError if the way-points do not begin at the start of the closure; the exceptions of
///           prepare_closure().
[[nodiscard]] PreparedWay prepare_way(Request request, double model_seconds,
                                      const SearchOptions& search, const FormingWatch& watch,
                                      DerivativesBy by = DerivativesBy::kVariables);

/// The piece that decides, if the branch is not followed through all.
struct PieceWithoutBranch {
  std::size_t index = 0;
  std::string obstacle{};                  ///< why it is not followed
  std::optional<Fold> fold{};              ///< a singular configuration on the piece
  std::optional<PreparedClosure> alone{};  ///< the question about this piece, if there is a fold

  [[nodiscard]] bool is_refuted() const { return fold && fold->is_on_branch; }
};

struct WayFinding {
  std::vector<ClosureResult> pieces;  ///< that were searched, in order
  std::vector<BranchPoint> begins;    ///< where each of them begins, approximately
  std::optional<PieceWithoutBranch> deciding{};
  std::optional<ThresholdFinding> threshold{};  ///< as ClosureFinding::threshold
  Result result;                                ///< in the terms of a check, of all pieces

  /// The branch is shown to be one, along all pieces.
  [[nodiscard]] bool is_proved() const { return !deciding; }
  [[nodiscard]] bool is_refuted() const { return deciding && deciding->is_refuted(); }
};

/// Follows the branch piece by piece. A piece begins with the configuration at the end of the one
/// before it, and each of its boxes there must hold the same configurations. The first piece on which
/// that fails ends the search. Then compares a threshold.
[[nodiscard]] WayFinding check_way(PreparedWay& prepared, const SearchOptions& search,
                                   const FormingWatch& watch, const PiecesRun& run = {});

/// Decides every part of the pieces, down to `resolution`, up to the first piece that the branch does
/// not follow to its end. There it looks for the end of the branch.
[[nodiscard]] WayFinding pave_way(PreparedWay& prepared, const SearchOptions& search,
                                  double resolution, const FormingWatch& watch,
                                  const PiecesRun& run = {});

}  // namespace regulus::detail
