// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_proof.hpp"

#include <algorithm>
#include <cstdio>
#include <span>
#include <sstream>
#include <vector>

#include "runtime/formal/coq_claim.hpp"
#include "runtime/formal/coq_closure.hpp"
#include "runtime/formal/coq_expression.hpp"
#include "runtime/formal/coq_force.hpp"
#include "runtime/formal/coq_load.hpp"
#include "runtime/formal/coq_parts.hpp"
#include "runtime/formal/coq_places.hpp"
#include "runtime/formal/coq_platform.hpp"
#include "runtime/formal/coq_question.hpp"
#include "runtime/formal/coq_solutions.hpp"
#include "runtime/formal/coq_spectrum.hpp"
#include "runtime/verifier/pieces.hpp"
#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/question.hpp"
#include "runtime/verifier/solution_lines.hpp"

namespace regulus::verifier {
namespace {

constexpr std::size_t kLegsInSpace = 6;
/// The most splits one after the other that Coq makes.
constexpr int kDeepest = 60;

std::string method(const CoqQuestion& question) {
  return "\nDefinition the_method : method := Method " + std::to_string(question.second_order) +
         " " + std::to_string(kDeepest) + ".\n";
}

/// A number of a certificate. The ends of a range become numbers beyond it, which Coq moves.
std::string coq_coordinate(std::string_view word) {
  if (word == "lower" || word == "upper") return word == "lower" ? "neg_infinity" : "infinity";
  if (word.find(':') != std::string_view::npos)
    throw Unfinished("there is no theorem about a range that contains no double yet");
  const double x = read_double(word);
  char text[40];
  std::snprintf(text, sizeof text, x < 0 ? "(%a)" : "%a", x);
  return text;
}

/// Reads the line `KEY …` with this many numbers behind it.
std::vector<std::string> numbers_of_line(Lines& lines, std::string_view key, std::size_t count) {
  if (!lines.next()) throw Rejection("the file ends before the line 'end'");
  std::string_view rest = lines.text();
  if (!rest.starts_with(key) || words_of(rest.substr(key.size())).size() != count)
    throw Rejection("expected '" + std::string(key) + "' and " + std::to_string(count) +
                    " numbers");
  std::vector<std::string> numbers;
  for (const std::string_view word : words_of(rest.substr(key.size()))) numbers.emplace_back(word);
  return numbers;
}

std::string coq_coordinates(const std::vector<std::string>& numbers) {
  std::vector<CoqItem> coordinates;
  for (const std::string& number : numbers) coordinates.push_back({"", coq_coordinate(number)});
  return coq_list(coordinates, "   ") + "%float";
}

/// Reads the line `point SIGN …`.
std::string coq_point(Lines& lines, std::string_view sign, std::size_t variables) {
  return coq_coordinates(numbers_of_line(lines, "point " + std::string(sign) + ' ', variables));
}

/// Coq searches two points on the line through those of the certificate.
std::string segment_theorem(Lines& lines, const Question& question) {
  const std::string positive = coq_point(lines, "+", question.variables.size());
  const std::string negative = coq_point(lines, "-", question.variables.size());
  return "\n(** Two points on a line along which the determinant changes its sign. *)\n"
         "Definition negative : coordinates :=\n  " +
         negative + ".\nDefinition positive : coordinates :=\n  " + positive + ".\n" +
         (question.has_threshold
              ? coq_claim("determinant_not_above the_question the_scales the_threshold",
                          "check_crossing_correct the_question the_scales the_threshold negative "
                          "positive")
              : coq_claim("singularity the_question",
                          "check_singularity_correct the_question negative positive"));
}

std::string point_theorem(Lines& lines, const Question& question) {
  return "\n(** A point at which the determinant is at most the threshold. *)\n"
         "Definition the_point : coordinates :=\n  " +
         coq_point(lines, "0", question.variables.size()) + ".\n" +
         coq_claim("determinant_not_above the_question the_scales the_threshold",
                   "check_point_correct the_question the_scales the_threshold the_point");
}

std::string singular_theorem(Lines& lines, const Question& question) {
  if (!lines.next()) throw Rejection("the file ends before the line 'end'");
  if (lines.text() == "reason small-determinant" && question.has_threshold)
    return point_theorem(lines, question);
  if (lines.text() == "reason opposite-signs") return segment_theorem(lines, question);
  if (lines.text() == "reason small-determinant")
    throw Unfinished(
        "there is no theorem yet about a singular pose at which the determinant does not change "
        "its "
        "sign");
  if (lines.text() == "reason always-singular")
    throw Unfinished("there is no theorem yet about a robot that is singular at every pose");
  throw Unfinished("there is no theorem about SINGULARITY by '" + lines.text() + "' yet");
}

/// `claim arguments`, of the question or of each piece, and the check that proves it.
std::string theorem_of_pieces(const std::string& claim, const std::string& check,
                              const std::string& arguments, bool has_pieces) {
  const std::string applied = check + (has_pieces ? "_pieces" : "") + "_correct the_question" +
                              arguments + " the_method" + (has_pieces ? " pieces" : "");
  if (!has_pieces) return coq_claim(claim + " the_question" + arguments, applied);
  return coq_claim(
      "Forall (fun piece => " + claim + " (the_question piece)" + arguments + ") pieces", applied);
}

/// The theorem about each point of the set; of each piece, if the question has pieces.
std::string regular_theorem(const Question& question, bool has_pieces) {
  if (question.has_threshold)
    return theorem_of_pieces("determinant_above", "check_determinant", " the_scales the_threshold",
                             has_pieces);
  return theorem_of_pieces("no_singularity", "check", "", has_pieces);
}

/// The values of the constants of each piece. Empty: the question has no pieces.
std::string pieces_text(const Pieces& pieces, Graph& graph) {
  std::vector<CoqItem> values;
  for (std::size_t k = 0; k < pieces.values.size(); ++k) {
    std::vector<CoqItem> value;
    for (const std::string& constant : pieces.values_of(k)) {
      static_cast<void>(parse(constant, {}, graph));
      value.push_back({"", coq_expression(constant, {})});
    }
    values.push_back({"", coq_list(value, std::string(4, ' '))});
  }
  if (values.empty()) return "";
  return "\nDefinition pieces : list (list expression) :=\n  " + coq_list(values, "   ") + ".\n";
}

/// The theorem about a force. `bordered`: the question of the certificate, or that of its first piece.
std::string force(const Question& bordered, const std::vector<std::string>& lines,
                  const Pieces& pieces) {
  const ForceQuestion force = split_force(bordered, lines);
  std::istringstream text(force.question);
  Lines plain(text);
  Question question;
  read_question(plain, question);
  std::vector<std::string> with_load = lines_of(force.question);
  for (const std::string& expression : force.load) with_load.push_back("load " + expression);
  const CoqQuestion coq = coq_question(with_load, question, pieces.names);
  const std::string kind = force.is_two_sided ? "force_within" : "force_below";
  const std::string of_pieces = pieces_text(pieces, question.graph);
  return coq_heading(question, describe(force)) + coq.text +
         "\n(** The row of the force, the first being row 0, and the limit. *)\n"
         "Definition the_row : nat := " +
         std::to_string(force.row) +
         ".\nDefinition the_limit : expression := " + coq_expression(force.limit, {}) + ".\n" +
         of_pieces + method(coq) +
         theorem_of_pieces(kind, "check_" + kind, " the_row the_load the_limit",
                           !of_pieces.empty());
}

/// The theorem about singular values. `certified`: the question of the certificate, or that of its
/// first piece.
std::string spectrum(const Question& certified, const std::vector<std::string>& lines,
                     const Pieces& pieces) {
  const SpectrumQuestion split = split_spectrum(certified, lines);
  std::istringstream text(split.question);
  Lines plain(text);
  Question question;
  read_question(plain, question);
  std::vector<std::string> with_factors = lines_of(split.question);
  with_factors.insert(with_factors.end(), split.more.begin(), split.more.end());
  const CoqQuestion coq = coq_question(with_factors, question, pieces.names);
  const std::string of_pieces = pieces_text(pieces, question.graph);
  return coq_heading(certified) + coq.text +
         "Definition the_limit : expression := " + coq_expression(split.limit, {}) + ".\n" +
         of_pieces + method(coq) +
         theorem_of_pieces(split.claim, "check_" + split.claim, " the_scales the_factors the_limit",
                           !of_pieces.empty());
}

/// The parts that the theorem about a paving of a load keeps.
std::string feasible_parts(Lines& lines, const Question& paved, const VariablesOfCoq& variables) {
  if (paved.is_index)
    throw Unfinished(
        "the theorem about a paving has the boxes of one file; write the proof without shards");
  const TubeOfLeaf no_tube = [](std::string_view, auto) { return ""; };
  const std::vector<TreeOfBoxes> trees{read_tree_of_boxes(lines, variables, no_tube)};
  require_end_of_trees(lines);
  const auto is_kept = [](std::string_view word) { return word == format::kFeasibleLeaf; };
  if (std::ranges::none_of(trees[0], [&](const BoxOfTree& box) { return is_kept(box.word); }))
    throw Unfinished("no box of the paving is feasible: a theorem would say nothing");
  return coq_parts_definition(
      "The parts in which the forces are within the limits. The theorem says nothing of the parts "
      "that are left out. The variables are numbered from 0, as their ranges.",
      "the_parts", trees, false, is_kept);
}

/// The theorem about a load that no forces within limits hold, at the point of the certificate.
std::string shortage(Lines& lines, const Question& question, const LimitsQuestion& limits) {
  if (!lines.next() || lines.text() != "reason shortage")
    throw Rejection("expected 'reason shortage'");
  const std::vector<std::string> own =
      numbers_of_line(lines, "point 0 ", question.variables.size());
  const std::vector<std::string> along = numbers_of_line(lines, "direction ", question.columns);
  std::vector<double> direction;
  for (const std::string& number : along) direction.push_back(read_double(number));
  std::vector<std::string> load = farthest_load(question, limits.of_load, direction);
  std::vector<std::string> point(limits.variables.count);
  for (std::size_t k = 0; k < own.size(); ++k) point[limits.variables.places[k]] = own[k];
  auto next = load.begin();
  for (std::string& coordinate : point)
    if (coordinate.empty()) coordinate = *next++;
  return "\n(** A point, and a direction along which the load needs more than the forces can give. "
         "*)\nDefinition the_point : coordinates :=\n  " +
         coq_coordinates(point) + ".\nDefinition the_direction : coordinates :=\n  " +
         coq_coordinates(along) + ".\n" +
         coq_claim("no_forces_within_limits the_question the_scales the_load the_limits",
                   "check_no_forces_correct the_question the_scales the_load the_limits the_point "
                   "the_direction");
}

/// The theorem about forces within limits. `feasible`: the question of the certificate, or that of its
/// first piece.
std::string limits(Lines& proof, const Question& feasible, const std::vector<std::string>& lines,
                   const Pieces& pieces) {
  const LimitsQuestion limits = split_limits(feasible, lines);
  std::istringstream text(limits.question);
  Lines plain(text);
  Question question;
  read_question(plain, question);
  std::vector<std::string> with_load = lines_of(limits.question);
  with_load.insert(with_load.end(), limits.more.begin(), limits.more.end());
  const CoqQuestion coq = coq_question(with_load, question, pieces.names);
  const std::string of_pieces = pieces_text(pieces, question.graph);
  const std::string arguments = " the_scales the_load the_limits";
  if (feasible.load->verdict == format::kInfeasible) {
    if (!of_pieces.empty()) throw Rejection("a load that is not held is on one piece");
    return coq_heading(feasible) + coq.text + shortage(proof, feasible, limits);
  }
  if (!feasible.paves)
    return coq_heading(feasible) + coq.text + of_pieces + method(coq) +
           theorem_of_pieces("forces_within_limits", "check_limits", arguments, !of_pieces.empty());
  if (!of_pieces.empty())
    throw Unfinished("there is no theorem about a paving of a load along pieces");
  return coq_heading(feasible) + coq.text + feasible_parts(proof, feasible, limits.variables) +
         method(coq) +
         theorem_of_pieces("forces_within_limits_in", "check_limits_in", " the_parts" + arguments,
                           false);
}

/// The question has the constants of a piece as an argument; the theorem is about all pieces.
std::string trajectory(Lines& lines, CoqStatement statement) {
  const Pieces pieces = read_pieces(lines);
  std::istringstream text(pieces.question_of(0));
  Lines first(text);
  Question question;
  read_question(first, question);
  if (question.solutions) throw Rejection("solutions are at one place, and on no pieces");
  const std::vector<std::string> kept = lines_of(pieces.question_of(0));
  question.is_piecewise = true;
  if (question.closure) return coq_heading(question) + coq_closure(lines, question, kept, pieces);
  if (question.singular) throw Rejection("a singular pose lies on one piece: there are several");
  if (question.load) return limits(lines, question, kept, pieces);
  if (is_about_spectrum(question) && statement == CoqStatement::kClaim)
    return spectrum(question, kept, pieces);
  if (question.quantity || statement == CoqStatement::kForce) return force(question, kept, pieces);
  const CoqQuestion coq = coq_question(kept, question, pieces.names);
  const std::string of_pieces = pieces_text(pieces, question.graph);
  return coq_heading(question) + coq.text + of_pieces + method(coq) +
         regular_theorem(question, !of_pieces.empty());
}

/// Reads the question, and what its theorem needs of the proof.
std::string read_and_write(Lines& lines, CoqStatement statement, Question& question,
                           std::vector<std::string>& kept) {
  const bool is_about_places = lines.next() && lines.text() == format::kPlacesMagic;
  if (is_about_places) return places_theorem(lines, question);
  if (lines.text() == format::kPlacesIndexMagic)
    throw Unfinished(
        "the theorem about the places of a table has those of one file; write the proof without "
        "shards");
  lines.repeat();
  lines.keep();
  read_question(lines, question);
  if (question.solutions) {
    kept = lines.take_kept();
    if (!question.closure && question.solutions->legs.size() == kLegsInSpace)
      return platform_theorem(lines, question, kept);
    if (lines.next() && lines.text().starts_with(kFromLine)) throw Unfinished(kNoTheoremOfFollowed);
    return solutions_theorem(question, kept);
  }
  if (statement == CoqStatement::kForce && question.closure && !question.quantity)
    throw Unfinished("this certificate of a closure states no force");
  if (question.is_piecewise) return trajectory(lines, statement);
  if (question.closure) {
    kept = lines.take_kept();
    return coq_heading(question) + coq_closure(lines, question, kept, {});
  }
  if (question.load) {
    const std::vector<std::string> own = lines.take_kept();
    return limits(lines, question, own, {});
  }
  if (is_about_spectrum(question) && statement == CoqStatement::kClaim)
    return spectrum(question, lines.take_kept(), {});
  if (question.quantity || statement == CoqStatement::kForce)
    return force(question, lines.take_kept(), {});
  kept = lines.take_kept();
  const CoqQuestion coq = coq_question(kept, question);
  if (question.singular)
    return coq_heading(question) + coq.text + singular_theorem(lines, question);
  return coq_heading(question) + coq.text + method(coq) + regular_theorem(question, false);
}

/// `question` is complete after this, and `kept` has its lines.
std::string proof_of(std::istream& certificate, CoqStatement statement, Question& question,
                     std::vector<std::string>& kept) {
  Lines lines(certificate);
  try {
    return read_and_write(lines, statement, question, kept);
  } catch (const Rejection& why) {
    throw Rejection("line " + std::to_string(lines.number()) + ": " + why.what());
  }
}

}  // namespace

std::string coq_proof(std::istream& certificate, CoqStatement statement) {
  Question question;
  std::vector<std::string> lines;
  return proof_of(certificate, statement, question, lines);
}

std::string coq_proof(std::istream& certificate, CoqStatement statement, const CoqModel& model,
                      CoqRobot& robot) {
  Question question;
  std::vector<std::string> lines;
  std::string text = proof_of(certificate, statement, question, lines);
  if (question.solutions) {
    robot.reason =
        "there is no theorem about the solutions of a model file yet: the_claim states equations "
        "from the certificate";
    return text;
  }
  if (question.closure) {
    robot.reason =
        "there is no theorem about a model file with [closure] yet: the_claim states the equations "
        "of the certificate";
    return text;
  }
  if (is_about_spectrum(question)) {
    robot.reason =
        "there is no theorem about the singular values of a model file yet: the_claim states the "
        "matrix, its scales and its factors from the certificate";
    return text;
  }
  if (question.quantity || question.load) {
    robot.reason =
        "there is no theorem about the forces of a model file yet: the_claim states the matrix and "
        "the load of the certificate";
    return text;
  }
  try {
    robot.text = coq_geometry(question, lines, model);
  } catch (const std::runtime_error& why) {
    robot.reason = why.what();
  }
  return text;
}

}  // namespace regulus::verifier
