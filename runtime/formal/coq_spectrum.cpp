// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_spectrum.hpp"

#include "runtime/formal/coq_load.hpp"
#include "runtime/verifier/branch_singular_values.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {

bool is_about_spectrum(const Question& question) {
  return question.quantity && !question.closure && is_singular_value(question.quantity->kind);
}

SpectrumQuestion split_spectrum(const Question& question, const std::vector<std::string>& lines) {
  if (question.singular)
    throw Unfinished(
        "there is no theorem yet that a singular value or a condition number is attained");
  const std::string& kind = question.quantity->kind;
  SpectrumQuestion split{question_with({}, question, lines, "quantity ", ""),
                         {},
                         rests_of(lines, "bound").front(),
                         kind == format::kCondition2 ? "condition_2_below"
                         : kind == format::kSigmaMin ? "singular_values_above"
                                                     : "singular_values_below"};
  if (rests_of(lines, "scale").empty()) split.more.assign(question.rows, "scale 1");
  for (const std::string& factor : rests_of(lines, "factor"))
    split.more.push_back("factor " + factor);
  return split;
}

}  // namespace regulus::verifier
