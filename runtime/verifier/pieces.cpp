// SPDX-License-Identifier: Apache-2.0
// The question about a piece is the text of the common question, with a line `constant` for each
// name of `piecewise`. It is read anew for each piece by the reader of any other question, so that a
// piece is proved exactly as a certificate of its own.
#include "runtime/verifier/pieces.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <sstream>

#include "runtime/files/sha256.hpp"
#include "runtime/verifier/bordered_matrix.hpp"
#include "runtime/verifier/branch_joint.hpp"
#include "runtime/verifier/branch_quantity.hpp"
#include "runtime/verifier/branch_tree.hpp"
#include "runtime/verifier/fold_path.hpp"
#include "runtime/verifier/model/closure_comparison.hpp"
#include "runtime/verifier/model/model_comparison.hpp"
#include "runtime/verifier/model/waypoints.hpp"
#include "runtime/verifier/nominal_copy.hpp"
#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/quantity_lines.hpp"
#include "runtime/verifier/shards.hpp"
#include "runtime/verifier/single_values.hpp"
#include "runtime/verifier/tree_reader.hpp"

namespace regulus::verifier {
namespace {

std::string piece(std::size_t k) { return "piece " + std::to_string(k + 1); }

void advance(Lines& lines) {
  if (!lines.next()) throw Rejection("the file ends before its line 'end'");
}

class PieceChecker {
 public:
  PieceChecker(Lines& lines, const Options& options, Verification& result)
      : lines_(lines),
        options_(options),
        rest_(options),
        result_(result),
        pieces_(read_pieces(lines)) {
    result_.pieces = pieces_.values.size();
  }

  void check() {
    advance(lines_);
    read_value();
    result_.are_sides = has_all_sides();
    for (std::size_t k = 0; k < pieces_.values.size(); ++k) {
      const bool is_last = k + 1 == pieces_.values.size();
      if (is_last && lines_.text().starts_with("reason ")) return check_fold(k);
      if (lines_.text() != "tree") throw Rejection("expected the line 'tree' of " + piece(k));
      check_piece(k);
      if (is_last && question_->singular && !question_->quantity)
        throw Rejection("the last piece has no singular configuration");
    }
    const auto words = words_of(lines_.text());
    if (words.size() != 2 || words[0] != "end") throw Rejection("expected 'end LEAVES'");
    if (read_count(words[1], std::size_t(-1)) != result_.leaves)
      throw Rejection("the line 'end' gives a wrong number of leaves");
    if (lines_.next()) throw Rejection("there is text after the line 'end'");
  }

  /// The same for trees in shards. A shard may begin at any piece, so all are compared before.
  void check_index() {
    advance(lines_);
    read_value();
    lines_.repeat();
    result_.are_sides = has_all_sides();
    for (std::size_t k = 0; k == 0 || (is_compared() && k < pieces_.values.size()); ++k) {
      read(k);
      if (question_->singular && !is_attained_bound(*question_))
        throw Rejection("an index is for the proof of a claim about all poses");
      require_value_line();
      if (is_compared()) compare(*question_, k);
    }
    check_shards(lines_,
                 {pieces_.sha256, true, pieces_.values.size(),
                  [this](std::size_t k) {
                    read(k);
                    enclose();
                    place_value(k);
                    return TreeQuestion{*question_, *variety_};
                  }},
                 options_, result_);
  }

 private:
  [[nodiscard]] bool is_compared() const { return !options_.model_text.empty(); }

  /// Reads the question of a piece.
  void read(std::size_t k) {
    std::istringstream text(pieces_.question_of(k));
    Lines head(text);
    Question& question = question_.emplace();
    try {
      read_question(head, question);
    } catch (const Rejection& why) {
      throw Rejection(piece(k) + ": line " + std::to_string(head.number()) +
                      " of its question: " + why.what());
    }
    if (question.closure) read_closure(k);
    if (question.singular && !question.closure)
      throw Rejection("a singular pose lies on one piece: there are several");
    if (k == 0) describe(question);
    if (!value_) show_threshold_by_fold(question);
    question.graph.end_of_file();
  }

  /// The line `value PIECE X …`, if a bound over a branch is attained.
  void read_value() {
    const auto words = words_of(lines_.text());
    if (words[0] != format::kValue) return;
    if (words.size() < 2) throw Rejection("the line 'value' names no piece");
    value_ = PlaceOfValue{read_count(words[1], pieces_.values.size()), lines_.number()};
    if (value_->piece == 0) throw Rejection("pieces are numbered from 1");
    value_->place.assign(words.begin() + 2, words.end());
    advance(lines_);
  }

  void require_value_line() const {
    if (value_.has_value() != is_attained_bound(*question_))
      throw Rejection(value_ ? "a line 'value' is for a bound over a branch that is attained"
                             : "there is no line 'value'");
  }

  /// Gives the place of the value to the piece on which it is.
  void place_value(std::size_t k) {
    require_value_line();
    if (!value_ || value_->piece != k + 1) return;
    lines_.name_line(value_->line);
    const std::vector<std::string_view> words(value_->place.begin(), value_->place.end());
    read_place_of_value(words, *question_, *variety_);
    lines_.name_line(0);
  }

  /// A branch goes on from one piece to the next, where the equations of both are equal.
  void read_closure(std::size_t k) {
    result_.are_sides = false;
    question_->continues = k > 0;
    require_piece_of_closure(pieces_, *question_);
    if (k > 0) require_joint(pieces_, k, *question_);
  }

  /// Prepares it for the proof of leaves.
  void enclose() {
    if (question_->quantity && !question_->closure) border(*question_);
    if (is_finite_error(*question_)) add_nominal_copy(*question_);
    variety_.emplace(enclose_variety(*question_));
    put_in_single_values(*question_);
  }

  /// The branch that has come to a piece reaches a singular configuration on it.
  void check_fold(std::size_t k) {
    read(k);
    if (!question_->singular || question_->quantity)
      throw Rejection("expected the line 'tree' of " + piece(k));
    if (is_compared()) compare(*question_, k);
    enclose();
    check_fold_of_piece(lines_, *question_, *variety_, rest(), branch_ ? &*branch_ : nullptr,
                        result_);
  }

  void check_piece(std::size_t k) {
    read(k);
    if (is_compared()) compare(*question_, k);
    enclose();
    place_value(k);
    const Shown shown =
        check_tree_of_piece(lines_, *question_, *variety_, rest(), branch_, result_);
    shown_.has_met_variety |= shown.has_met_variety;
    shown_.has_met_point |= shown.has_met_point;
    // The constraints may exclude some pieces, but not all.
    if (k + 1 == pieces_.values.size()) require_poses(*question_, shown_, result_);
  }

  /// The options with the time that is left.
  const Options& rest() {
    if (options_.time_limit > 0) rest_.time_limit = options_.time_limit - seconds();
    if (rest_.time_limit < 0) throw Unfinished("the time limit was reached");
    return rest_;
  }

  void describe(const Question& question) {
    result_.claim = question.claim();
    result_.model = question.model;
    result_.sha256 = question.sha256;
    result_.motion = question.motion;
    describe_bound(question, result_);
  }

  /// Every piece is compared in full: a value of its own may stand in any line.
  void compare(Question& question, std::size_t k) {
    if (question.closure && question.matrix.empty()) {
      Question with_variables = with_unknowns(question);
      return compare(with_variables, k);
    }
    if (k == 0) begin_comparison(question);
    if (!waypoints_->is_named()) return compare_sides(question, k);
    const std::size_t poses = waypoints_->compare(question, k);
    std::vector<std::string> compared = waypoints_->compared_keys(question);
    for (const std::string& name : pieces_.names) compared.push_back("value " + name);
    compare_rest(question, k, compared, nullptr);
    result_.numbers += poses;
  }

  void compare_sides(Question& question, std::size_t k) {
    CutSides sides(question, pieces_.values_of(k));
    std::vector<std::string> compared = sides.constraints();
    for (const std::string& name : pieces_.names) compared.push_back("value " + name);
    compare_rest(question, k, compared, &sides);
  }

  void compare_rest(Question& question, std::size_t k, const std::vector<std::string>& compared,
                    CutSides* sides) {
    Verification of_piece;
    compare_with_file(question, model_, options_, of_piece, compared, sides);
    if (k == 0) result_.numbers += of_piece.numbers;
    for (const std::string& difference : of_piece.differences)
      if (std::ranges::find(result_.differences, difference) == result_.differences.end())
        result_.differences.push_back(difference);
  }

  void begin_comparison(const Question& question) {
    model_ = read_model_values(options_.model_text);
    waypoints_.emplace(model_, question.motion, options_.model_name, options_.waypoints);
    const std::size_t count = pieces_.values.size();
    if (!waypoints_->is_named() && result_.are_sides) return;
    if (!waypoints_->is_named())
      throw Unfinished("the certificate has " + std::to_string(count) +
                       " pieces, and the motion names no file of way-points; name it by "
                       "--waypoints");
    // A branch that reaches a singular configuration ends on the last piece of its certificate.
    const bool may_end = question.singular && !question.quantity;
    if (may_end ? waypoints_->pieces() < count : waypoints_->pieces() != count)
      throw OtherModel("the certificate is not about " + waypoints_->file() + ": it has " +
                       std::to_string(count) + " pieces, the file " +
                       std::to_string(waypoints_->pieces()));
  }

  [[nodiscard]] bool has_all_sides() const {
    std::vector<std::vector<std::string>> values;
    for (std::size_t k = 0; k < pieces_.values.size(); ++k) values.push_back(pieces_.values_of(k));
    return are_all_signs(values) && end_in_sides(pieces_.after, pieces_.names);
  }

  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  Lines& lines_;
  const Options& options_;
  Options rest_;  ///< with the time that is left
  Verification& result_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  const Pieces pieces_;
  /// The place where a bound is attained.
  struct PlaceOfValue {
    std::size_t piece = 0;  ///< from 1
    std::uint64_t line = 0;
    std::vector<std::string> place{};
  };
  std::optional<PlaceOfValue> value_{};
  std::optional<Question> question_;  ///< of the current piece
  std::optional<Variety> variety_;
  WrittenValues model_;
  std::optional<WaypointComparison> waypoints_;
  Shown shown_;                        ///< by all pieces
  std::optional<BranchBoxes> branch_;  ///< of a closure, on the last piece
};

}  // namespace

Pieces read_pieces(Lines& lines) {
  Pieces pieces;
  detail::Sha256 question;
  std::vector<std::string> before = lines.take_kept();
  for (std::size_t i = 0; i + 1 < before.size(); ++i) pieces.before += before[i] + '\n';
  for (std::size_t i = 1; i < before.size(); ++i) question.add(before[i] + '\n');
  for (const std::string_view word : words_of(before.back())) pieces.names.emplace_back(word);
  pieces.names.erase(pieces.names.begin());
  if (pieces.names.empty() || pieces.names.size() > format::kMostPieceNames)
    throw Rejection("the line 'piecewise' has too few or too many names");
  for (advance(lines); lines.text().starts_with("piece "); advance(lines)) {
    if (pieces.values.size() == format::kMostPieces) throw Rejection("there are too many pieces");
    pieces.values.push_back(lines.text().substr(6));
    question.add(lines.text() + '\n');
  }
  if (pieces.values.empty()) throw Rejection("there is no piece");
  for (std::size_t count = 0; lines.text() != "proof"; advance(lines)) {
    if (++count > format::kMostLines) throw Rejection("there are too many lines before 'proof'");
    pieces.after += lines.text() + '\n';
  }
  pieces.after += "proof\n";
  question.add(pieces.after);
  pieces.sha256 = question.text();
  return pieces;
}

std::vector<std::string> Pieces::values_of(std::size_t k) const {
  constexpr std::string_view kBetween = " | ";
  std::vector<std::string> result;
  std::string_view rest = values[k];
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::size_t end = rest.find(kBetween);
    if ((end == std::string_view::npos) != (i + 1 == names.size()))
      throw Rejection(piece(k) + " has a wrong number of values");
    result.emplace_back(rest.substr(0, end));
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + kBetween.size());
  }
  return result;
}

std::string Pieces::question_of(std::size_t k) const {
  const std::vector<std::string> constants = values_of(k);
  std::string text = before;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += "constant " + names[i] + " = " + constants[i] + '\n';
  return text + after;
}

void check_pieces(Lines& lines, bool is_index, const Options& options, Verification& result) {
  PieceChecker checker(lines, options, result);
  is_index ? checker.check_index() : checker.check();
}

}  // namespace regulus::verifier
