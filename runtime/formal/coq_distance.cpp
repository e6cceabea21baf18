// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_distance.hpp"

#include <numeric>

#include "runtime/formal/coq_expression.hpp"
#include "runtime/formal/coq_load.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

/// The lines before the quantity, as a question about the branch.
std::string without_quantity(const Question& question, const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) {
    if (line.starts_with("quantity ")) break;
    text += line.starts_with("claim ")
                ? "claim " + format::describe_closure_claim(question.claimed_set(), false)
                : line;
    text += '\n';
  }
  return text + "proof\n";
}

/// The numbers of the uncertain quantities and of the errors among the variables.
std::string numbers_of_errors(const Question& question) {
  std::string text = "[";
  for (std::size_t k = 0; k < question.variables.size(); ++k)
    if (question.variables[k].kind != VariableKind::kParameter)
      text += (text.size() == 1 ? "" : "; ") + std::to_string(k);
  return text + "]%nat";
}

}  // namespace

BranchQuantityText split_distance(const Question& question, const std::vector<std::string>& lines) {
  if (question.singular)
    throw Unfinished("there is no theorem yet that a value is attained on a branch");
  BranchQuantityText text;
  text.question = without_quantity(question, lines);
  text.places.resize(question.variables.size());
  std::iota(text.places.begin(), text.places.end(), std::size_t(0));
  text.definitions =
      "\n(** What has an error, as numbers of variables: without errors these are in the middles "
      "of "
      "their\n    ranges. *)\nDefinition the_errors : list nat := " +
      numbers_of_errors(question) +
      ".\n\n(** The unknown that the errors move, the first one being unknown 0; and the limit. "
      "*)\n"
      "Definition the_unknown : nat := " +
      std::to_string(question.quantity->columns.front()) +
      ".\nDefinition the_limit : expression := " +
      coq_expression(rests_of(lines, "bound").front(), {}) + ".\n";
  text.claim = "finite_error_within";
  text.arguments = " the_errors the_unknown the_limit";
  return text;
}

}  // namespace regulus::verifier
