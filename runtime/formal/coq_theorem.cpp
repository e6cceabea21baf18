// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_theorem.hpp"

#include <algorithm>
#include <array>

#include "runtime/formal/coq_audit.hpp"
#include "runtime/formal/coq_question.hpp"
#include "runtime/formal/coqc.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

/// Real numbers and classical logic; what the processor's numbers are. A plain file cannot declare a
/// module, so no axiom of its own has such a name.
constexpr auto kAxioms = std::to_array<std::string_view>(
    {"ClassicalDedekindReals.sig_forall_dec", "ClassicalDedekindReals.sig_not_dec",
     "Classical_Prop.classic", "FunctionalExtensionality.functional_extensionality_dep"});
constexpr auto kModules =
    std::to_array<std::string_view>({"FloatAxioms.", "PrimFloat.", "PrimInt63.", "Uint63."});

bool is_axiom_of_the_library(std::string_view name) {
  return std::ranges::find(kAxioms, name) != kAxioms.end() ||
         std::ranges::any_of(kModules, [&](std::string_view m) { return name.starts_with(m); });
}

/// Why Coq refuses a file, in a few lines.
std::string reason_of(std::string_view output) {
  constexpr std::size_t kMost = 600;
  const std::size_t error = output.find("Error:");
  if (error != std::string_view::npos) output.remove_prefix(error);
  std::string text(output.substr(0, kMost));
  std::ranges::replace(text, '\n', ' ');
  return text;
}

void require(const Coqc::Answer& answer, const std::string& what) {
  if (!answer.is_accepted) throw Rejection(what + reason_of(answer.text));
}

std::string theorem_anew(const std::string& name, const std::string& type) {
  return "Theorem audited_" + name + " : " + type + ".\nProof. exact " + kAuditedFolder + '.' +
         kAuditedFile + '.' + name + ". Qed.\n";
}

/// A file that states all theorems of the audited one, and lists their axioms.
std::string statements_anew(const PlainTheorem& theorem) {
  std::string text = std::string(
                         "Require Coq.Lists.List Regulus.Questions Regulus.Closures Regulus.Limits "
                         "Regulus.SingularValues "
                         "Regulus.Branches Regulus.Ways Regulus.Rates Regulus.Slopes "
                         "Regulus.Distances Regulus.Poses ") +
                     kAuditedFolder + '.' + kAuditedFile + ".\n" +
                     theorem_anew("the_claim", theorem.type);
  std::string names = "audited_the_claim";
  if (!theorem.geometry.empty()) text += theorem.geometry_import + theorem.definitions;
  for (const PlainGeometry& robot : theorem.geometry) {
    text += theorem_anew(robot.name, robot.statement);
    names += ", audited_" + robot.name;
  }
  return text + "Definition audited_theorems := (" + names +
         ").\nPrint Assumptions audited_theorems.\n";
}

}  // namespace

void check_assumptions(std::string_view answer) {
  bool has_answer = false;
  while (!answer.empty()) {
    const std::string_view line = take_until(answer, "\n");
    if (line == "Axioms:" || line == "Closed under the global context") {
      has_answer = true;
    } else if (!line.empty() && line.front() != ' ') {
      const std::string name(line.substr(0, line.find(' ')));
      if (!is_axiom_of_the_library(name))
        throw Rejection("the theorem rests on '" + name + "', which is no axiom of the library");
    }
  }
  if (!has_answer) throw Rejection("Coq does not say what the theorem rests on");
}

ProvedTheorem prove_by_coq(std::string_view text, const std::string& library, double time_limit) {
  const PlainTheorem theorem = read_plain_theorem(text);
  Coqc coqc(find_coq_library(library), time_limit);
  require(coqc.compile(kAuditedFile, std::string(text)), "Coq refuses the file: ");
  const Coqc::Answer answer = coqc.compile("audit", statements_anew(theorem));
  require(answer, "the theorem does not state its claim: ");
  check_assumptions(answer.text);
  ProvedTheorem proved{{theorem.statement}, theorem.may_be_empty};
  for (const PlainGeometry& robot : theorem.geometry)
    proved.statements.push_back(robot.name + " : " + robot.statement);
  return proved;
}

}  // namespace regulus::verifier
