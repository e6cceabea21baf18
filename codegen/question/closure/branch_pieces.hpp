// SPDX-License-Identifier: GPL-3.0-or-later
// A branch over a motion, in the pieces in which it is followed: a motion along way-points has a piece
// for each segment, one over ranges is a piece. A threshold of the motion has no meaning here.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "codegen/question/closure/closure_report.hpp"
#include "codegen/question/closure/closure_way.hpp"
#include "codegen/question/closure/piece_values.hpp"

namespace regulus::detail {

class BranchInPieces {
 public:
  /// Forms the kernel.
  ///
  /// Requires  request.model.closure.
  /// Throws    as prepare_closure() and prepare_way().
  BranchInPieces(const Request& request, double model_seconds, const SearchOptions& search,
                 const FormingWatch& watch, DerivativesBy by);

  /// Follows the branch through all pieces.
  void follow(const SearchOptions& search, const FormingWatch& watch, const PiecesRun& run);

  /// Decides every part instead, down to `resolution`: pave_closure(), pave_way().
  void pave(const SearchOptions& search, double resolution, const FormingWatch& watch,
            const PiecesRun& run);

  /// The kernel of all pieces; its request is about the common question.
  [[nodiscard]] PreparedClosure& common() { return prepared_.common; }
  [[nodiscard]] const PreparedClosure& common() const { return prepared_.common; }
  /// Returns the file of way-points; null over ranges.
  [[nodiscard]] const Trajectory* trajectory() const {
    return prepared_.request.motion.trajectory.get();
  }
  [[nodiscard]] std::size_t pieces() const { return prepared_.pieces(); }

  // After follow() or pave().
  [[nodiscard]] const WayFinding& found() const { return found_; }
  [[nodiscard]] const PreparedWay& way() const { return prepared_; }
  /// Returns the singular configurations that were found over ranges, also those on no branch.
  [[nodiscard]] const std::vector<Fold>& folds() const { return folds_; }
  [[nodiscard]] bool is_proved() const { return found_.is_proved(); }
  [[nodiscard]] bool is_empty() const;  ///< over ranges: the motion has no pose
  /// Returns the piece that ends in a singular configuration of the branch; null if none is shown.
  [[nodiscard]] const PieceWithoutBranch* end() const;
  /// Returns the question about the piece that ends.
  [[nodiscard]] const PreparedClosure& question_of_end() const;
  /// Returns why the branch is not proved; empty if it is.
  [[nodiscard]] std::string obstacle() const;
  [[nodiscard]] std::uint64_t boxes() const;
  /// Returns what ended the work of the last piece: the search of its boxes, or that of their links.
  [[nodiscard]] std::optional<Reason> stopped_by() const;
  /// Returns the pieces that were reached, which live as long as this.
  [[nodiscard]] PiecesOfBranch reached() const { return pieces_of(prepared_, found_); }
  /// Writes the proof that the branch ends. Requires end().
  [[nodiscard]] ProofStatus certify_end(const std::string& path, const ProofPlacing& placing) const;

 private:
  void take(ClosureFinding found);

  PreparedWay prepared_;  ///< over ranges with one piece, which has no constants
  WayFinding found_;
  std::vector<Fold> folds_;
};

}  // namespace regulus::detail
