// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/condition/condition_certificate.hpp"

#include <fmt/format.h>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/question/bound/bound_certificate.hpp"
#include "runtime/proof/format.hpp"

namespace regulus {

ConditionCertificate::ConditionCertificate(const std::string& path, const Request& request,
                                           const Component& component,
                                           const std::set<std::string>& uncertain,
                                           const ProofPlacing& placing)
    : proofs_(path, placing, "no bound was proved", "no pose shows it", "upper", "attained"),
      request_(request),
      component_(component),
      uncertain_(uncertain) {}

CertifiedQuestion ConditionCertificate::question(const GiNaC::ex& number,
                                                 const std::set<std::string>& uncertain) const {
  Bordered itself;
  itself.is_reciprocal = false;
  return certified_bound(request_, component_, itself, number, uncertain);
}

CertifiedQuestion ConditionCertificate::question_of_singularity(
    const std::set<std::string>& uncertain) const {
  return certified_bound(request_, component_, Bordered{}, 0, uncertain);
}

bool ConditionCertificate::is_refused(const CertifiedQuestion& question, bool is_singular) {
  const std::string obstacle = certificate_obstacle(question, is_singular);
  if (obstacle.empty()) return false;
  proofs_.set_no_safe(obstacle);
  proofs_.set_no_singular(obstacle);
  return true;
}

void ConditionCertificate::prove(const BoundEnd& end) {
  if (!proofs_.are_wanted()) return;
  const CertifiedQuestion question = this->question(end.exact, uncertain_);
  if (is_refused(question, false)) return;
  const auto file = with_file_errors([&] {
    auto proof = std::make_shared<ProofFile>(proofs_.safe_file());
    proof->begin(question.head(false));
    tree_.write_to(*proof, certificate_word);
    proof->complete();
    return proof;
  });
  proofs_.write_safe(file, "below " + rounded_text(end, RoundTo::kAbove));
}

void ConditionCertificate::attain(const BoundEnd& end, const std::vector<Interval>& variables) {
  if (!proofs_.are_wanted()) return;
  const CertifiedQuestion question = this->question(end.exact, uncertain_);
  if (is_refused(question, true)) return;
  std::string witness = fmt::format("reason {}\npoint 0", format::kRatio);
  for (const Interval& x : variables) witness += ' ' + coordinate_text(x);
  proofs_.write_singular(question.head(true), witness + "\nend\n",
                         "attains " + rounded_text(end, RoundTo::kBelow));
}

void ConditionCertificate::note_ratio() {
  proofs_.set_no_safe(
      "it is the ratio of the bounds of sigma-max and sigma-min, which have one each");
}

void ConditionCertificate::show_singular(const Result& result,
                                         const std::set<std::string>& uncertain) {
  if (proofs_.are_wanted()) write_singular(result, uncertain);
}

void ConditionCertificate::show_singular(const std::vector<Interval>& variables) {
  if (!proofs_.are_wanted()) return;
  const GiNaC::matrix& matrix = request_.model.matrix;
  Result result;
  result.verdict = Verdict::kSingularity;
  result.reason = matrix.rows() == matrix.cols() ? Reason::kSmallDeterminant : Reason::kLostRank;
  result.witness.emplace().points.push_back({variables, {}, {}, {}, {}});
  write_singular(result, uncertain_);
}

void ConditionCertificate::write_singular(const Result& result,
                                          const std::set<std::string>& uncertain) {
  const CertifiedQuestion question = question_of_singularity(uncertain);
  if (is_refused(question, true)) return;
  proofs_.write_singular(question.head(true), witness_lines(result), "the matrix is singular");
}

}  // namespace regulus
