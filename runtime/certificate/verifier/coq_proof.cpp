// SPDX-License-Identifier: Apache-2.0
#include "runtime/certificate/verifier/coq_proof.hpp"

#include <algorithm>
#include <cstdio>
#include <set>
#include <span>
#include <sstream>
#include <vector>

#include "runtime/certificate/verifier/coq_expression.hpp"
#include "runtime/certificate/verifier/pieces.hpp"
#include "runtime/certificate/verifier/proof.hpp"
#include "runtime/certificate/verifier/question.hpp"

namespace regulus::verifier {
namespace {

/// The most splits one after the other that Coq makes.
constexpr int kDeepest = 60;

/// An item of a list, and the comment before it.
struct Item {
  std::string comment, text;
};

/// Takes the part of `text` before `mark`, and `mark`; all of it if there is none.
std::string_view take_until(std::string_view& text, std::string_view mark) {
  const std::size_t at = text.find(mark);
  const std::string_view taken = text.substr(0, at);
  text.remove_prefix(at == std::string_view::npos ? text.size() : at + mark.size());
  return taken;
}

std::string coq_list(const std::vector<Item>& items, const std::string& margin) {
  std::string text = "[";
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) text += ";\n" + margin;
    if (!items[i].comment.empty()) text += "(* " + items[i].comment + " *) ";
    text += items[i].text;
  }
  return text + "]";
}

/// Turns the lines of a question that has been read without a fault into definitions of Coq.
class CoqQuestion {
 public:
  /// `piece_names`: the constants that each piece of a trajectory gives a value.
  CoqQuestion(std::vector<std::string> lines, const Question& question,
              const std::vector<std::string>& piece_names = {})
      : lines_(std::move(lines)), q_(question), piece_names_(piece_names) {
    declare_variables();
    for (const std::string& line : lines_) read(line);
  }

  [[nodiscard]] std::string text() const {
    std::string text =
        "(** The names: the variables, then the definitions of the question. *)\n" + names_text_ +
        "\n(** The question, in the order of its certificate: the ranges of the "
        "variables, the definitions,\n    the constraints, more expressions that "
        "must have a value, the matrix and its number of columns. *)\n"
        "Definition the_question " +
        (piece_names_.empty() ? "" : "(piece : list expression) ") + ": question := Question\n";
    for (const auto* list : {&ranges_, &definitions_, &constraints_, &defined_})
      text += "  " + coq_list(*list, "   ") + "\n";
    text += "  " + matrix() + "\n  " + std::to_string(q_.columns) + ".\n";
    return q_.has_threshold ? text + threshold() : text;
  }

  /// The number of variables that are kept to the second order. Each uncertain quantity is small
  /// and there are many.
  [[nodiscard]] std::size_t second_order() const {
    return has_uncertain_ ? parameters_ : q_.variables.size();
  }

 private:
  /// The variables come first, whatever the order of their lines.
  void declare_variables() {
    for (const std::string& line : lines_) {
      std::string_view rest = line;
      const std::string_view key = take_until(rest, " ");
      if (key == "pose" && rest.find(" +- ") != std::string_view::npos)
        with_error_.emplace(take_until(rest, " = "));
    }
    for (const Variable& v : q_.variables) {
      parameters_ += v.kind == VariableKind::kParameter;
      has_uncertain_ |= v.kind == VariableKind::kUncertain;
      const bool is_error = v.kind == VariableKind::kError;
      const std::string name = is_error ? v.name.substr(0, v.name.find(' ')) : v.name;
      const std::string identifier = fresh(is_error                     ? error_of(name)
                                           : with_error_.contains(name) ? commanded(name)
                                                                        : coq_identifier(name));
      declare(identifier);
      if (!is_error) commanded_[name] = identifier;
      if (v.kind == VariableKind::kUncertain) actual_[name] = identifier;
    }
  }

  static std::string commanded(std::string_view name) { return std::string(name) + "'commanded"; }
  static std::string error_of(std::string_view name) { return std::string(name) + "'error"; }

  /// A shared expression may have the name of a parameter that the matrix does not use.
  std::string fresh(std::string identifier) {
    while (!declared_.insert(identifier).second) identifier += '\'';
    return identifier;
  }

  void declare(const std::string& identifier) {
    names_text_ += "Definition " + identifier + " := Name " + std::to_string(next_name_++) + ".\n";
  }

  void define(const std::string& identifier, const std::string& expression) {
    declare(identifier);
    definitions_.push_back({identifier, expression});
  }

  void read(const std::string& line) {
    std::string_view rest = line;
    const std::string_view key = take_until(rest, " ");
    if (key == "parameter") {
      read_parameter(rest);
    } else if (key == "constant") {
      const std::string name(take_until(rest, " = "));
      commanded_[name] = actual_[name] = fresh(coq_identifier(name));
      define(actual_[name], constant(name, rest));
    } else if (key == "uncertain") {
      read_uncertain(rest);
    } else if (key == "ball") {
      read_ball(rest);
    } else if (key == "pose") {
      read_pose(rest);
    } else if (key == "alpha") {
      threshold_ = coq_expression(rest, {});
    } else if (key == "let") {
      const std::string name(take_until(rest, " = "));
      const std::string expression = coq_expression(rest, actual_);
      actual_[name] = fresh(coq_identifier(name));
      define(actual_[name], expression);
    } else {
      read_list(key, rest);
    }
  }

  [[nodiscard]] std::string constant(const std::string& name, std::string_view value) const {
    const auto found = std::find(piece_names_.begin(), piece_names_.end(), name);
    if (found == piece_names_.end()) return coq_expression(value, {});
    return "nth " + std::to_string(found - piece_names_.begin()) + " piece no_entry";
  }

  void read_list(std::string_view key, std::string_view rest) {
    if (key == "entry")
      entries_.push_back({"", coq_expression(rest, actual_)});
    else if (key == "scale")
      scales_.push_back({"", coq_expression(rest, actual_)});
    else if (key == "defined")
      defined_.push_back({"", coq_expression(rest, actual_)});
    else if (key == "motion-defined")
      defined_.push_back({"", coq_expression(rest, commanded_)});
    else if (key == "reach")
      constraints_.push_back({"reach", "- (" + coq_expression(rest, commanded_) + ")"});
    else if (key == "constraint")
      constraints_.push_back({"", coq_expression(rest, commanded_)});
  }

  void read_parameter(std::string_view rest) {
    const std::string_view name = take_until(rest, " in ");
    const std::string lower = coq_expression(take_until(rest, " : "), {});
    ranges_.push_back(
        {commanded_.find(name)->second, "(" + lower + ", " + coq_expression(rest, {}) + ")"});
  }

  void read_uncertain(std::string_view rest) {
    const std::string name(take_until(rest, " = "));
    const std::string middle = coq_expression(take_until(rest, " +- "), {});
    const std::string spread = coq_expression(rest, {});
    ranges_.push_back({actual_[name], "within (" + middle + ") (" + spread + ")"});
    middles_[name] = middle;
    spreads_[name] = spread;
  }

  /// A ball is the constraint that the squared distance from its middle is at most ρ².
  void read_ball(std::string_view names) {
    std::string sum, radius;
    while (!names.empty()) {
      const std::string name(take_until(names, " "));
      sum += (sum.empty() ? "(" : " + (") + actual_[name] + " - (" + middles_[name] + ")) ^ 2";
      radius = spreads_[name];
    }
    constraints_.push_back({"ball", sum + " - (" + radius + ") ^ 2"});
  }

  /// Poses are read before `let`, so a pose is defined by parameters and constants alone.
  void read_pose(std::string_view rest) {
    const std::string name(take_until(rest, " = "));
    const std::string expression = coq_expression(take_until(rest, " +- "), pose_scope());
    const bool has_error = with_error_.contains(name);
    if (!commanded_.contains(name)) {
      commanded_[name] = fresh(has_error ? commanded(name) : coq_identifier(name));
      define(commanded_[name], expression);
    }
    actual_[name] = has_error ? fresh(coq_identifier(name)) : commanded_[name];
    if (!has_error) return;
    ranges_.push_back({error_of(name), "within 0 (" + coq_expression(rest, {}) + ")"});
    define(actual_[name], commanded_[name] + " + " + error_of(name));
  }

  /// A pose cannot use an earlier one unless that is a parameter.
  const CoqNames& pose_scope() {
    if (pose_scope_.empty()) pose_scope_ = commanded_;
    return pose_scope_;
  }

  [[nodiscard]] std::string threshold() const {
    return "\n(** The scales of the rows, and the threshold. *)\n"
           "Definition the_scales : list expression :=\n  " +
           coq_list(scales_, "   ") + ".\nDefinition the_threshold : expression := " + threshold_ +
           ".\n";
  }

  [[nodiscard]] std::string matrix() const {
    std::vector<Item> rows;
    for (std::size_t i = 0; i < q_.rows; ++i) {
      const auto begin = entries_.begin() + std::ptrdiff_t(i * q_.columns);
      rows.push_back(
          {"", coq_list({begin, begin + std::ptrdiff_t(q_.columns)}, std::string(4, ' '))});
    }
    return coq_list(rows, "   ");
  }

  const std::vector<std::string> lines_;
  const Question& q_;
  const std::vector<std::string> piece_names_;
  std::size_t next_name_ = 0, parameters_ = 0;
  bool has_uncertain_ = false;
  std::set<std::string, std::less<>> with_error_;  ///< poses with a control error
  std::set<std::string> declared_;
  CoqNames commanded_, actual_, pose_scope_, middles_, spreads_;
  std::string names_text_, threshold_;
  std::vector<Item> ranges_, definitions_, constraints_, defined_, entries_, scales_;
};

std::string heading(const Question& q) {
  return "(* A theorem for the verdict of a certificate.\n\n   model   " + coq_comment(q.model) +
         "\n   sha256  " + coq_comment(q.sha256) + "\n   motion  " + coq_comment(q.motion) +
         "\n   claim   " + coq_comment(format::describe_claim(q.claimed_set(), q.singular)) +
         "\n\n   Check it with: coqc -Q FOLDER Regulus FILE. FOLDER has the compiled library. *)\n"
         "From Coq Require Import List.\n"
         "From Coq Require Import PrimFloat.\n"
         "From Regulus Require Import Expressions Questions Search Singularity Threshold.\n"
         "From Regulus Require Import Notations.\n"
         "Import ListNotations.\n\n";
}

/// `check`: the theorem that is applied, and its arguments.
std::string theorem(const std::string& claim, const std::string& check) {
  return "\nTheorem the_claim : " + claim + ".\nProof.\n  apply (" + check +
         ").\n  vm_cast_no_check (eq_refl true).\nQed.\n";
}

std::string method(const CoqQuestion& question) {
  return "\nDefinition the_method : method := Method " + std::to_string(question.second_order()) +
         " " + std::to_string(kDeepest) + ".\n";
}

/// A coordinate of a certificate. The ends of a range become numbers beyond it, which Coq moves.
std::string coq_coordinate(std::string_view word) {
  if (word == "lower" || word == "upper") return word == "lower" ? "neg_infinity" : "infinity";
  if (word.find(':') != std::string_view::npos)
    throw Unfinished("there is no theorem about a range that contains no double yet");
  const double x = read_double(word);
  char text[40];
  std::snprintf(text, sizeof text, x < 0 ? "(%a)" : "%a", x);
  return text;
}

/// Reads the line `point SIGN …`.
std::string coq_point(Lines& lines, std::string_view sign, std::size_t variables) {
  if (!lines.next()) throw Rejection("the file ends before the line 'end'");
  const auto words = words_of(lines.text());
  if (words.size() != variables + 2 || words[0] != "point" || words[1] != sign)
    throw Rejection("expected 'point " + std::string(sign) + "' and a number for each variable");
  std::vector<Item> coordinates;
  for (const std::string_view word : std::span(words).subspan(2))
    coordinates.push_back({"", coq_coordinate(word)});
  return coq_list(coordinates, "   ") + "%float";
}

/// Coq searches two points on the line through those of the certificate.
std::string segment_theorem(Lines& lines, const Question& question) {
  const std::string positive = coq_point(lines, "+", question.variables.size());
  const std::string negative = coq_point(lines, "-", question.variables.size());
  return "\n(** Two points on a line along which the determinant changes its sign. *)\n"
         "Definition negative : coordinates :=\n  " +
         negative + ".\nDefinition positive : coordinates :=\n  " + positive + ".\n" +
         (question.has_threshold
              ? theorem("determinant_not_above the_question the_scales the_threshold",
                        "check_crossing_correct the_question the_scales the_threshold negative "
                        "positive")
              : theorem("singularity the_question",
                        "check_singularity_correct the_question negative positive"));
}

std::string point_theorem(Lines& lines, const Question& question) {
  return "\n(** A point at which the determinant is at most the threshold. *)\n"
         "Definition the_point : coordinates :=\n  " +
         coq_point(lines, "0", question.variables.size()) + ".\n" +
         theorem("determinant_not_above the_question the_scales the_threshold",
                 "check_point_correct the_question the_scales the_threshold the_point");
}

std::string singular_theorem(Lines& lines, const Question& question) {
  if (!lines.next()) throw Rejection("the file ends before the line 'end'");
  if (lines.text() == "reason small-determinant" && question.has_threshold)
    return point_theorem(lines, question);
  if (lines.text() == "reason opposite-signs") return segment_theorem(lines, question);
  throw Unfinished("there is no theorem about SINGULARITY by '" + lines.text() + "' yet");
}

/// The theorem about each point of the set; of each piece, if the question has pieces.
std::string regular_theorem(const Question& question, bool has_pieces) {
  const std::string of_threshold = question.has_threshold ? " the_scales the_threshold" : "";
  const std::string check = std::string("check") + (question.has_threshold ? "_determinant" : "") +
                            (has_pieces ? "_pieces" : "") + "_correct the_question" + of_threshold +
                            " the_method";
  const std::string claim = question.has_threshold ? "determinant_above " : "no_singularity ";
  if (!has_pieces) return theorem(claim + "the_question" + of_threshold, check);
  return theorem(
      "Forall (fun piece => " + claim + "(the_question piece)" + of_threshold + ") pieces",
      check + " pieces");
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::string_view rest = text;
  while (!rest.empty()) lines.emplace_back(take_until(rest, "\n"));
  return lines;
}

/// The question has the constants of a piece as an argument; the theorem is about all pieces.
std::string trajectory(Lines& lines) {
  const Pieces pieces = read_pieces(lines);
  std::istringstream text(pieces.question_of(0));
  Lines first(text);
  Question question;
  read_question(first, question);
  if (question.singular) throw Rejection("a singular pose lies on one piece: there are several");
  const CoqQuestion coq(lines_of(pieces.question_of(0)), question, pieces.names);
  std::vector<Item> values;
  for (std::size_t k = 0; k < pieces.values.size(); ++k) {
    std::vector<Item> value;
    for (const std::string& constant : pieces.values_of(k)) {
      static_cast<void>(parse(constant, {}, question.graph));
      value.push_back({"", coq_expression(constant, {})});
    }
    values.push_back({"", coq_list(value, std::string(4, ' '))});
  }
  return heading(question) + coq.text() + "\nDefinition pieces : list (list expression) :=\n  " +
         coq_list(values, "   ") + ".\n" + method(coq) + regular_theorem(question, true);
}

/// Reads the question, and what its theorem needs of the proof.
std::string read_and_write(Lines& lines) {
  Question question;
  lines.keep();
  read_question(lines, question);
  if (question.is_piecewise) return trajectory(lines);
  const CoqQuestion coq(lines.take_kept(), question);
  if (question.singular) return heading(question) + coq.text() + singular_theorem(lines, question);
  return heading(question) + coq.text() + method(coq) + regular_theorem(question, false);
}

}  // namespace

std::string coq_proof(std::istream& certificate) {
  Lines lines(certificate);
  try {
    return read_and_write(lines);
  } catch (const Rejection& why) {
    throw Rejection("line " + std::to_string(lines.number()) + ": " + why.what());
  }
}

}  // namespace regulus::verifier
