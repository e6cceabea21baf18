// SPDX-License-Identifier: GPL-3.0-or-later
// What --certificate asks `regulus margin` for: a proof of each end of the bracket.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "codegen/margin/margin_question.hpp"
#include "codegen/support/earlier_outputs.hpp"
#include "runtime/certificate/writer.hpp"

namespace regulus::inline bracketing {

/// FILE.safe and FILE.singular. Each is put in its place, whole, when its end of the bracket moves:
/// what is found there at any time is a proof of an end, if perhaps not of the last one.
class MarginCertificates {
 public:
  /// `path` empty: none are wanted. Throws FileError when a file cannot be made there.
  MarginCertificates(std::string path, const MarginRequest& request, const ReportLabels& subject);

  /// The files of `path`; none if it is empty.
  [[nodiscard]] static std::vector<OutputFile> files(const std::string& path);

  [[nodiscard]] bool wanted() const noexcept { return !path_.empty(); }
  /// Watches a search at this value; nullptr if none is wanted. The one before is forgotten.
  [[nodiscard]] Observer* watch(const MarginValue& value);
  /// Of the search that was watched last, or of a witness that no search has found. Throws
  /// FileError.
  void finish(const MarginValue& value, const Result& result);

  /// A line of the report for each end; empty if none was wanted.
  [[nodiscard]] std::string lines() const;
  /// The key `certificates` of a JSON report: the files, null for an end that is not known.
  void add_to(nlohmann::ordered_json& report) const;

 private:
  struct Proved {
    std::string file;
    std::string value;
  };

  [[nodiscard]] CertifiedQuestion question_at(const MarginValue& value) const;

  std::string path_;
  const MarginRequest& request_;
  std::set<std::string> uncertain_;
  std::optional<CertificateWriter> search_;
  std::optional<Proved> safe_, singular_;
  std::string obstacle_;  ///< why there can be no certificate of this question
};

}  // namespace regulus::inline bracketing
