// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_closure.hpp"

#include <sstream>
#include <string_view>

#include "runtime/formal/coq_branch.hpp"
#include "runtime/formal/coq_claim.hpp"
#include "runtime/formal/coq_distance.hpp"
#include "runtime/formal/coq_parts.hpp"
#include "runtime/formal/coq_question.hpp"
#include "runtime/formal/coq_tubes.hpp"
#include "runtime/formal/coq_way.hpp"
#include "runtime/proof/format.hpp"
#include "runtime/verifier/branch_quantity.hpp"
#include "runtime/verifier/nominal_copy.hpp"

namespace regulus::verifier {
namespace {

/// The claim about the branch; the check that shows it has the same arguments.
struct ClaimOfBranch {
  std::string claim, check, arguments;
};

/// The definitions of the parts of a paving, and the arguments that they are.
struct PartsOfBranch {
  std::string text, arguments;
};

PartsOfBranch parts_of_branch(const Question& paved, const TreesOfTubes& trees, bool has_pieces) {
  PartsOfBranch parts{
      coq_parts_definition("The parts with the branch. The theorem says nothing of the parts that "
                           "are left out. The variables are numbered from 0, as their ranges.",
                           "the_parts", trees, has_pieces,
                           [](std::string_view word) { return format::has_tube(word); }),
      " the_parts"};
  if (!paved.quantity) return parts;
  parts.text += coq_parts_definition(
      "Those of them in which what is bounded is within its limits.", "the_feasible_parts", trees,
      has_pieces, [](std::string_view word) { return word == format::kFeasibleLeaf; });
  parts.arguments += " the_feasible_parts";
  return parts;
}

/// The closure of a theorem, its pieces, and its tubes, which are hints.
std::string theorem_of_tubes(Lines& lines, const Question& question, const CoqQuestion& coq,
                             const VariablesOfCoq& variables, const Pieces& pieces,
                             const ClaimOfBranch& claim) {
  const std::size_t count = pieces.values.size();
  const TreesOfTubes trees = read_trees_of_tubes(lines, question, variables, count);
  const PartsOfBranch parts =
      question.paves ? parts_of_branch(question, trees, count > 0) : PartsOfBranch{};
  const std::string kind = std::string(count == 0 ? "" : "_along") + (question.paves ? "_in" : "");
  const std::string all =
      (count == 0 ? " the_closure" : " the_closure pieces") + parts.arguments + claim.arguments;
  return (count == 0 ? "" : coq_way(pieces, question)) + parts.text + coq_tubes(trees, count > 0) +
         "\n(** The variables of second order, and how often a box is halved whose tube is too "
         "narrow. *)\nDefinition the_method : method := Method " +
         std::to_string(coq.second_order) + " 6.\n" +
         coq_claim(claim.claim + kind + all,
                   claim.check + kind + "_correct" + all + " the_method the_tubes");
}

/// The theorem about a quantity over the branch of a closure. Tubes of a finite error are those of the
/// mechanism and its copy.
std::string theorem_of_quantity(Lines& lines, const Question& question,
                                const std::vector<std::string>& kept, const Pieces& pieces) {
  const bool is_distance = is_finite_error(question);
  const BranchQuantityText branch =
      is_distance ? split_distance(question, kept) : split_branch(question, kept);
  std::istringstream text(branch.question);
  Lines plain(text);
  Question closure;
  read_question(plain, closure);
  CoqQuestion coq = coq_question(lines_of(branch.question), closure, pieces.names);
  if (is_distance) coq.second_order = closure.variables.size();
  const VariablesOfCoq variables{branch.places, closure.variables.size()};
  if (is_distance) add_nominal_copy(closure);
  return coq.text + branch.definitions +
         theorem_of_tubes(lines, is_distance ? closure : question, coq, variables, pieces,
                          {branch.claim, "check_" + branch.claim, branch.arguments});
}

}  // namespace

std::string coq_closure(Lines& lines, const Question& question,
                        const std::vector<std::string>& kept, const Pieces& pieces) {
  if (question.is_index)
    throw Unfinished(
        "the theorem about a closure has the tubes of one file; write the proof without shards");
  if (question.quantity) return theorem_of_quantity(lines, question, kept, pieces);
  if (question.singular)
    throw Unfinished("there is no theorem about a singular configuration of a closure yet");
  const CoqQuestion coq = coq_question(kept, question, pieces.names);
  VariablesOfCoq variables{{}, question.variables.size()};
  for (std::size_t k = 0; k < variables.count; ++k) variables.places.push_back(k);
  return coq.text + theorem_of_tubes(lines, question, coq, variables, pieces,
                                     {"one_branch", "check_closure", ""});
}

}  // namespace regulus::verifier
