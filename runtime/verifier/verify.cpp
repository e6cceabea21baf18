// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/verify.hpp"

#include "runtime/files/sha256.hpp"
#include "runtime/verifier/bordered_matrix.hpp"
#include "runtime/verifier/branch_quantity.hpp"
#include "runtime/verifier/fold_path.hpp"
#include "runtime/verifier/model/closure_comparison.hpp"
#include "runtime/verifier/model/model_comparison.hpp"
#include "runtime/verifier/model/waypoints.hpp"
#include "runtime/verifier/nominal_copy.hpp"
#include "runtime/verifier/pieces.hpp"
#include "runtime/verifier/places.hpp"
#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/quantity_lines.hpp"
#include "runtime/verifier/shards.hpp"
#include "runtime/verifier/single_values.hpp"
#include "runtime/verifier/solution_count.hpp"
#include "runtime/verifier/usual_environment.hpp"

namespace regulus::verifier {
namespace {

/// A trajectory has a singular pose on one of its pieces; other claims are about all of them.
void compare(Question& question, const Options& options, Verification& result, PlacePart* place) {
  if (question.closure && question.matrix.empty()) {
    Question with_variables = with_unknowns(question);
    return compare(with_variables, options, result, place);
  }
  const WrittenValues model = read_model_values(options.model_text);
  if (place != nullptr) return compare_place(question, model, options, *place, result);
  if (question.solutions && !options.waypoints.empty())
    throw OtherModel("the certificate is about one place, and not about those of " +
                     options.waypoints);
  if (question.solutions) return compare_with_file(question, model, options, result);
  const WaypointComparison waypoints(model, question.motion, options.model_name, options.waypoints);
  if (!waypoints.is_named()) return compare_with_file(question, model, options, result);
  if (!question.singular && waypoints.pieces() != 1)
    throw OtherModel("the certificate is not about " + waypoints.file() +
                     ": it is about one piece, and the file has " +
                     std::to_string(waypoints.pieces()));
  if (question.closure)
    waypoints.compare(question, 0);  // the branch begins at the start
  else
    waypoints.require_some_piece(question);
  compare_with_file(question, model, options, result, waypoints.compared_keys(question));
}

/// Returns the SHA-256 of the lines of an index from its second line to `proof`.
std::string digest_of(const std::vector<std::string>& head) {
  detail::Sha256 digest;
  for (std::size_t i = 1; i < head.size(); ++i) digest.add(head[i] + '\n');
  return digest.text();
}

/// True if the proof of the claim that a threshold is not exceeded has a singular configuration.
bool begins_with_fold(Lines& lines, const Question& question) {
  if (!question.singular || !has_threshold_of_branch(question) || question.is_index) return false;
  const bool is_fold = lines.next() && lines.text().starts_with("reason ");
  lines.repeat();
  return is_fold;
}

/// `place`: that of a table which the claim must be about; null: the file is about no table.
void check(Lines& lines, Question& question, const Options& options, Verification& result,
           PlacePart* place) {
  lines.keep();
  read_question(lines, question);
  if (question.is_index && question.singular && !question.is_piecewise &&
      !is_attained_bound(question))
    throw Rejection("an index is for the proof of a claim about all poses");
  if (question.is_index && question.solutions)
    throw Rejection("a claim about all solutions is in one file");
  if (place != nullptr && !question.solutions)
    throw Rejection("a part about a place has no claim about all solutions");
  if (question.is_piecewise) return check_pieces(lines, question.is_index, options, result);
  const std::vector<std::string> head = lines.take_kept();
  result.claim = question.claim();
  result.model = question.model;
  result.sha256 = question.sha256;
  result.motion = question.motion;
  question.graph.end_of_file();
  if (!options.model_text.empty()) compare(question, options, result, place);
  if (question.solutions) return check_solutions(lines, question, options, result);
  describe_bound(question, result);
  if (question.quantity && !question.closure) border(question);
  if (is_finite_error(question)) add_nominal_copy(question);
  const Variety variety = enclose_variety(question);
  put_in_single_values(question);
  if (begins_with_fold(lines, question)) show_threshold_by_fold(question);
  if (is_attained_bound(question)) read_value_line(lines, question, variety);
  if (question.is_index)
    check_shards(lines,
                 {.sha256 = digest_of(head),
                  .about =
                      [&](std::size_t) {
                        return TreeQuestion{question, variety};
                      }},
                 options, result);
  else if (question.singular && question.closure && !question.quantity)
    check_fold(lines, question, variety, options, result);
  else if (question.singular && !question.closure)
    check_witness(lines, question, variety, options, result);
  else
    check_tree(lines, question, variety, options, result);
}

/// Proves one part of a certificate about the places of a table.
void check_part(Lines& lines, const Options& options, PlacePart& place, Verification& result) {
  Question question;
  check(lines, question, options, result, &place);
}

std::string at_line(const Lines& lines, const std::string& why) {
  return "line " + std::to_string(lines.number()) + ": " + why;
}

/// Returns "448 feasible, 139 infeasible, 407 undecided"; empty if it is not a paving.
std::string describe_paved(const Verification& v) {
  std::string text;
  for (std::size_t i = 0; i < kPavedWords.size(); ++i)
    if (v.paved[i] > 0)
      text += (text.empty() ? "" : ", ") + std::to_string(v.paved[i]) + ' ' + kPavedWords[i];
  return text;
}

}  // namespace

Verification verify(std::istream& file, const Options& options) {
  const UsualEnvironment environment;
  require_usual_arithmetic();
  Verification result;
  Lines lines(file, options.max_bytes);
  Question question;
  try {
    const bool is_about_places = lines.next() && (lines.text() == format::kPlacesMagic ||
                                                  lines.text() == format::kPlacesIndexMagic);
    lines.repeat();
    if (is_about_places)
      check_places(lines, options, check_part, result);
    else
      check(lines, question, options, result, nullptr);
    result.outcome = Outcome::kVerified;
  } catch (const OtherModel& other) {
    result.outcome = Outcome::kRejected;
    result.reason = other.what();
  } catch (const Rejection& rejection) {
    result.outcome = Outcome::kRejected;
    result.reason = at_line(lines, rejection.what());
  } catch (const Unfinished& unfinished) {
    result.outcome = Outcome::kUnfinished;
    result.reason = at_line(lines, unfinished.what());
  }
  return result;
}

std::string describe(const Verification& v) {
  std::string text;
  const auto line = [&text](const std::string& key, const std::string& value) {
    if (!value.empty()) text += key + std::string(11 - key.size(), ' ') + value + '\n';
  };
  line("model", v.model);
  line("sha256", v.sha256);
  line("motion", v.motion);
  line("claim", v.claim);
  line("bound", v.bound);
  if (v.pieces > 0)
    line("pieces", std::to_string(v.pieces) +
                       (v.are_sides ? ", the sides of cuts of atan2, with either limit on them"
                                    : " of a trajectory"));
  if (v.places > 0) line("places", std::to_string(v.places) + ", each with its own proof");
  if (v.shards > 0) line("shards", std::to_string(v.shards));
  if (v.leaves > 0)
    line("leaves", std::to_string(v.leaves) + ", in " + std::to_string(v.boxes) +
                       (v.boxes == 1 ? " box" : " boxes"));
  line("paved", describe_paved(v));
  if (v.roots > 0)
    line("roots", std::to_string(v.roots) + " that differ are proved, " +
                      std::to_string(v.real_roots) + " of them real");
  if (v.links > 0)
    line("links", std::to_string(v.links) + " pairs of neighbours with one configuration");
  if (v.numbers > 0)
    line("numbers", std::to_string(v.numbers) +
                        (v.numbers == 1 ? " value" : " values and expressions") +
                        " of the model file compared");
  for (const std::string& difference : v.differences) line("differs", difference);
  line("note", v.note);
  line("reason", v.reason);
  return text;
}

const char* name(Outcome outcome) noexcept {
  switch (outcome) {
    case Outcome::kVerified:
      return "VERIFIED";
    case Outcome::kRejected:
      return "REJECTED";
    case Outcome::kUnfinished:
      break;
  }
  return "UNFINISHED";
}

}  // namespace regulus::verifier
