// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/margin/margin_certificates.hpp"

#include "codegen/answer/certificate/certificate_question.hpp"

namespace regulus::detail {

EndProofs margin_proofs(const std::string& path, const ProofPlacing& placing) {
  return EndProofs(path, placing, kNoSafeProof, kNoSingularProof);
}

MarginCertificates::MarginCertificates(EndProofs proofs, const MarginRequest& request,
                                       const ReportLabels& subject)
    : proofs_(std::move(proofs)), request_(request), uncertain_(uncertain_names(subject)) {
  // At the value 0, too, the search has a variable for each of them.
  if (proofs_.are_wanted()) uncertain_.merge(request_.with_control_errors());
}

CertifiedQuestion MarginCertificates::question_at(const MarginValue& value) const {
  return request_.certified_at(value).question(uncertain_);
}

Observer* MarginCertificates::watch(const MarginValue& value) {
  search_.reset();
  if (!proofs_.are_wanted()) return nullptr;
  CertifiedQuestion question = question_at(value);
  if (is_refused(question, false)) return nullptr;
  try {
    with_file_errors([&] {
      search_ = std::make_shared<CertificateWriter>(proofs_.safe_file(), std::move(question));
    });
  } catch (const FileError& why) {
    proofs_.lose_safe(why.what());
  }
  return search_.get();
}

void MarginCertificates::finish(const MarginValue& value, const Result& result) {
  const bool singular = result.verdict == Verdict::kSingularity;
  if (result.verdict == Verdict::kNoSingularity && search_) {
    const auto complete = [&] {
      with_file_errors([&] { static_cast<void>(search_->complete(result)); });
      return std::shared_ptr<ProofFile>(search_, &search_->file());
    };
    proofs_.write_safe(complete, "safe at " + value.text);
  }
  search_.reset();
  if (!singular || !proofs_.are_wanted()) return;
  const CertifiedQuestion question = question_at(value);
  if (is_refused(question, true)) return;
  proofs_.write_singular(question.head(true), witness_lines(result), "singular at " + value.text);
}

bool MarginCertificates::is_refused(const CertifiedQuestion& question, bool singular) {
  const std::string obstacle = certificate_obstacle(question, singular);
  if (obstacle.empty()) return false;
  proofs_.set_no_safe(obstacle);
  proofs_.set_no_singular(obstacle);
  return true;
}

}  // namespace regulus::detail
