// SPDX-License-Identifier: GPL-3.0-or-later
// A branch over a motion, in the pieces in which it is followed, and the largest value over it: a motion
// along way-points has a piece for each segment, one over ranges is a piece.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "codegen/question/closure/closure_report.hpp"
#include "codegen/question/closure/closure_way.hpp"
#include "codegen/question/closure/value_certificate.hpp"
#include "codegen/question/closure/value_search.hpp"

namespace regulus {

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

class BranchInPieces {
 public:
  /// Forms the kernel.
  ///
  /// Requires  request.model.closure.
  /// Throws    as prepare_closure() and prepare_way().
  BranchInPieces(const Request& request, double model_seconds, const SearchOptions& search,
                 const FormingWatch& watch, DerivativesBy by);

  /// Follows the branch through all pieces. `progress` may be null; `keep`: over ranges alone.
  void follow(const SearchOptions& search, const FormingWatch& watch, Observer* progress,
              const KeepBranch& keep = {});

  /// Takes what was found over ranges instead.
  void take(ClosureFinding found);

  /// The kernel of all pieces; its request is about the common question.
  [[nodiscard]] PreparedClosure& common() { return prepared_.common; }
  [[nodiscard]] const PreparedClosure& common() const { return prepared_.common; }
  /// Returns the file of way-points; null over ranges.
  [[nodiscard]] const Trajectory* trajectory() const {
    return prepared_.request.motion.trajectory.get();
  }
  [[nodiscard]] std::size_t pieces() const { return prepared_.pieces(); }
  /// Encloses the commanded value of each pose parameter on a part of a segment.
  ///
  /// Requires  trajectory().
  [[nodiscard]] std::vector<Interval> commanded(std::size_t piece, const Interval& s) const;
  /// Returns "theta = 0.3 rad": the commanded pose on a segment, about.
  ///
  /// Requires  trajectory().
  [[nodiscard]] std::string pose_at(std::size_t piece, const Interval& s) const;

  // After follow().
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
  [[nodiscard]] std::optional<Reason> stopped_by() const;
  /// Returns what certificates are about. The trees live as long as this.
  [[nodiscard]] ProvedPieces proved() const;
  /// The same with other trees, of all pieces.
  [[nodiscard]] ProvedPieces proved(const std::vector<BranchTree>& trees) const;
  /// Writes the proof that the branch ends. Requires end().
  [[nodiscard]] ProofStatus certify_end(const std::string& path, const ProofPlacing& placing) const;

  /// Brackets the largest f piece by piece, or compares it with a limit: what one piece attains is known
  /// to the next ones. With several pieces each has its share of the limits that are left.
  ///
  /// Requires  is_proved(). `progress` may be null.
  /// Throws    the exceptions of the workers.
  [[nodiscard]] BracketOfPieces bracket(const BranchValue& value, ValueAim aim,
                                        const BoxSearchSettings& settings,
                                        Observer* progress) const;

 private:
  PreparedWay prepared_;  ///< over ranges with one piece, which has no constants
  WayFinding found_;
  std::vector<Fold> folds_;
};

}  // namespace regulus
