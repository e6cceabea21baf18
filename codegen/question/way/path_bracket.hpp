// SPDX-License-Identifier: GPL-3.0-or-later
// Brackets the largest value at which a trajectory has no singular pose, piece by piece.
//
// A piece that is certified at a value is certified at every smaller one, because its set only grows
// with the value. So all pieces are searched together (path_search.hpp) slightly below the least
// value that has a witness. A piece that this leaves open gets a bracket of its own, which certifies
// it there or finds a witness at a smaller value. The largest value for the trajectory is the
// smallest of those of its pieces.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "codegen/answer/report/output_options.hpp"
#include "codegen/question/engine/search_topic.hpp"
#include "codegen/question/margin/margin_run.hpp"
#include "codegen/question/margin/prepared_margin.hpp"
#include "codegen/question/way/path_bounds.hpp"
#include "codegen/support/time_budget.hpp"

namespace regulus::detail {

/// A singular pose on one piece, at a value.
struct PieceWitness {
  std::size_t piece = 0;
  PreparedMargin margin;  ///< of the question about the piece
  MarginStep step;
};

struct PathBracketSettings {
  SearchOptions search;
  TimeBudget budget;  ///< of all searches
  OutputOptions output;
  const std::atomic<bool>* interrupt = nullptr;
  SearchTopic topic{};  ///< of the question
  /// Returns roughly the value at which a piece becomes singular; nullopt if it cannot.
  std::function<std::optional<double>(std::size_t piece)> guess;
  /// Returns the searches of a piece by an earlier run, or null.
  std::function<std::unique_ptr<EarlierSearches>(std::size_t piece, const MarginQuestion&)> earlier;
};

class PathBracket {
 public:
  /// Forms the matrix. `request`: its motion has a trajectory, and the parameter of the question
  /// unless this is the threshold. `alone`: the same with a matrix that is singular at the same
  /// places, for the pieces that are searched alone. `question`: from 0, of a parameter or the
  /// threshold. All must live as long as this.
  ///
  /// Throws    UsageError for options that a motion along way-points does not have; the exceptions
  ///           of PreparedMargin.
  PathBracket(const Request& request, const Request& alone, const MarginQuestion& question,
              PathBracketSettings settings);

  /// Searches until the bracket is as narrow as `gap`, relative to its upper end, or the time is
  /// over. A later call goes on with a smaller gap.
  void close(double gap);

  /// Returns the largest value at which every piece is certified; nullopt if there is none.
  [[nodiscard]] std::optional<MarginValue> certified() const;
  /// Returns the witness with the least value; null if none was found.
  [[nodiscard]] PieceWitness* witness() const noexcept { return witness_.get(); }
  /// True if the constraints exclude every pose of every piece.
  [[nodiscard]] bool is_empty() const;
  /// True if no piece was left open at the last value that close() aimed at.
  [[nodiscard]] bool is_closed() const noexcept { return is_closed_; }
  [[nodiscard]] std::uint64_t boxes() const noexcept { return boxes_; }
  [[nodiscard]] const StageSeconds& seconds() const noexcept { return seconds_; }

 private:
  [[nodiscard]] bool must_stop() const;
  [[nodiscard]] PreparedMargin prepare(const MarginQuestion& question, Request request);
  [[nodiscard]] MarginValue target(double gap) const;
  [[nodiscard]] bool is_certified(std::size_t piece, double value) const;
  [[nodiscard]] std::vector<std::size_t> open_pieces(double value) const;
  [[nodiscard]] std::size_t most_promising(const std::vector<std::size_t>& pieces) const;
  void search_together(const MarginValue& value, std::uint32_t most_boxes);
  void bracket_piece(std::size_t piece, std::optional<MarginValue> high, double gap);
  void keep(std::size_t piece, PreparedMargin margin, Margin found);
  void certify_lower();

  const Request& request_;
  const Request& alone_;
  const MarginQuestion& question_;
  PathBracketSettings settings_;
  const PathBounds path_;
  std::optional<PreparedMargin> hull_;
  std::vector<std::optional<double>> certified_;  ///< by piece: the largest value
  std::vector<bool> excluded_;                    ///< by piece: no pose remains
  std::vector<bool> undecided_;                   ///< by piece: a bracket of its own did not end
  struct {
    double value = -1;
    std::uint32_t most_boxes = 0;
  } searched_;  ///< the last call of search_together
  std::unique_ptr<PieceWitness> witness_;
  bool is_closed_ = false;
  std::uint64_t boxes_ = 0;
  StageSeconds seconds_;
};

}  // namespace regulus::detail
