// SPDX-License-Identifier: GPL-3.0-or-later
// A branch over a motion, in the pieces in which it is followed, and the largest value over it: a motion
// along way-points has a piece for each segment, one over ranges is a piece.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "codegen/answer/report/json_checkpoint.hpp"
#include "codegen/question/closure/closure_report.hpp"
#include "codegen/question/closure/closure_way.hpp"
#include "codegen/question/closure/value_certificate.hpp"
#include "codegen/question/closure/value_search.hpp"
#include "codegen/question/engine/search_topic.hpp"

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

/// The file that has searches of a branch, for the option --checkpoint.
struct KeptPieces {
  JsonCheckpoint* file = nullptr;  ///< null: none
  /// Seconds between two saves, at most; nullopt: the usual ones.
  std::optional<double> interval{};
  std::string name{};  ///< of the searches in the file

  /// Runs a search with its place in the file, if there is one. `part`: of the name of the place.
  template <class BoxSettings, class Search>
  auto run(BoxSettings settings, const Search& search, const std::string& part = "") const {
    if (file == nullptr) return search(settings);
    if (interval) settings.save_every = *interval;
    return file->continue_search(settings, search, name + part);
  }
};

/// How the searches of all pieces are watched, shared and kept.
struct PiecesRun {
  Observer* progress = nullptr;  ///< may be null
  SearchTopic topic{};           ///< for other processes, without what tells one piece from another
  KeptPieces kept{};
};

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
  /// Encloses the commanded value of each pose parameter on a part of a segment.
  ///
  /// Requires  trajectory().
  [[nodiscard]] std::vector<Interval> commanded(std::size_t piece, const Interval& s) const;
  /// Returns "theta = 0.3 rad": the commanded pose on a segment, about.
  ///
  /// Requires  trajectory().
  [[nodiscard]] std::string pose_at(std::size_t piece, const Interval& s) const;

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
  /// Returns what certificates are about. The trees live as long as this.
  [[nodiscard]] ProvedPieces proved() const;
  /// The same with other trees, of all pieces.
  [[nodiscard]] ProvedPieces proved(const std::vector<BranchTree>& trees) const;
  /// Writes the proof that the branch ends. Requires end().
  [[nodiscard]] ProofStatus certify_end(const std::string& path, const ProofPlacing& placing) const;

  /// Brackets the largest f piece by piece, or compares it with a limit: what one piece attains is known
  /// to the next ones. With several pieces each has its share of the limits that are left.
  ///
  /// Requires  is_proved().
  /// Throws    the exceptions of the workers.
  [[nodiscard]] BracketOfPieces bracket(const BranchValue& value, ValueAim aim,
                                        const BoxSearchSettings& settings,
                                        const PiecesRun& run) const;

  /// Tells other processes that the next search is about this piece.
  void turn_to_piece(cluster::Workers* workers, SearchTopic topic, std::size_t piece) const;
  /// Returns what a file calls the search of this piece, after its name: nothing over ranges.
  [[nodiscard]] std::string part_of_name(std::size_t piece) const;

 private:
  void take(ClosureFinding found);
  [[nodiscard]] KeepPiece keep_pieces(const KeptPieces& kept) const;

  PreparedWay prepared_;  ///< over ranges with one piece, which has no constants
  WayFinding found_;
  std::vector<Fold> folds_;
};

/// The question about one piece, for searches of values.
///
/// Requires  a branch that was followed or paved as far as there, and outlives this.
struct QuestionOfPiece {
  QuestionOfPiece(const BranchInPieces& branch, std::size_t piece);
  QuestionOfPiece(const QuestionOfPiece&) = delete;
  QuestionOfPiece& operator=(const QuestionOfPiece&) = delete;

  const Problem problem;
  const ClosureQuestion closure;
  SystemBoxes system;
  const IsPossible is_possible;
};

/// Returns the settings of the next of so many pieces, which has its share of what is left.
[[nodiscard]] BoxSearchSettings share_of(const BoxSearchSettings& all, std::uint64_t spent_boxes,
                                         double spent_seconds, std::size_t pieces);

}  // namespace regulus
