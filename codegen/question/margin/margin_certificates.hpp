// SPDX-License-Identifier: GPL-3.0-or-later
// The option --certificate of `regulus margin`: a proof of each end of the bracket.
#pragma once

#include <memory>
#include <set>
#include <string>

#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/question/margin/margin_question.hpp"
#include "runtime/proof/writer.hpp"

namespace regulus::detail {

/// Returns the proofs FILE.safe and FILE.singular of the ends at which a run stops, without the
/// endings. `path` empty: none are wanted. Throws FileError if a file cannot be created there.
[[nodiscard]] EndProofs margin_proofs(const std::string& path, const ProofPlacing& placing);

/// Writes them.
class MarginCertificates {
 public:
  MarginCertificates(EndProofs proofs, const MarginRequest& request, const ReportLabels& subject);

  /// Returns the observer of a search at this value; nullptr if none is wanted. It replaces the
  /// previous one. A file that cannot be written is noted.
  [[nodiscard]] Observer* watch(const MarginValue& value);
  /// Writes the certificate of the last observed search, or of a witness that no search has found.
  /// A file that cannot be written is noted.
  void finish(const MarginValue& value, const Result& result);

  [[nodiscard]] const EndProofs& proofs() const noexcept { return proofs_; }

 private:
  [[nodiscard]] CertifiedQuestion question_at(const MarginValue& value) const;
  [[nodiscard]] bool is_refused(const CertifiedQuestion& question, bool singular);

  EndProofs proofs_;
  const MarginRequest& request_;
  std::set<std::string> uncertain_;
  std::shared_ptr<CertificateWriter> search_;
};

}  // namespace regulus::detail
