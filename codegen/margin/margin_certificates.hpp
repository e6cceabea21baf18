// SPDX-License-Identifier: GPL-3.0-or-later
// The option --certificate of `regulus margin`: a proof of each end of the bracket.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "codegen/margin/end_proofs.hpp"
#include "codegen/margin/margin_question.hpp"
#include "codegen/support/earlier_outputs.hpp"
#include "codegen/support/held_files.hpp"
#include "runtime/certificate/writer.hpp"

namespace regulus::inline bracketing {

/// FILE.safe and FILE.singular: proofs of the ends at which the run stops.
class MarginCertificates {
 public:
  /// `path` empty: none are wanted. `held`: where the proofs wait for the end of the run; null: each
  /// is put in place at once. Throws FileError if a file cannot be created there.
  MarginCertificates(std::string path, const MarginRequest& request, const ReportLabels& subject,
                     HeldFiles* held = nullptr);

  /// Returns the files of `path`; none if it is empty.
  [[nodiscard]] static std::vector<OutputFile> files(const std::string& path);

  [[nodiscard]] bool wanted() const noexcept { return !path_.empty(); }
  /// Returns the observer of a search at this value; nullptr if none is wanted. It replaces the
  /// previous one.
  [[nodiscard]] Observer* watch(const MarginValue& value);
  /// Writes the certificate of the last observed search, or of a witness that no search has found.
  /// Throws FileError.
  void finish(const MarginValue& value, const Result& result);

  /// Returns what has been written, for the reports.
  [[nodiscard]] EndProofs proofs() const;

 private:
  struct Proved {
    std::string file;
    std::string value;
  };

  [[nodiscard]] CertifiedQuestion question_at(const MarginValue& value) const;
  void finish(std::shared_ptr<CertificateWriter> writer, const Result& result) const;

  std::string path_;
  const MarginRequest& request_;
  std::set<std::string> uncertain_;
  HeldFiles* held_;
  std::shared_ptr<CertificateWriter> search_;
  std::optional<Proved> safe_, singular_;
  std::string obstacle_;  ///< why this question can have no certificate
};

}  // namespace regulus::bracketing
