// SPDX-License-Identifier: GPL-3.0-or-later
// Collects what a page shows: the findings of earlier runs, and runs for the rest.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "codegen/answer/kinds.hpp"
#include "codegen/answer/services.hpp"
#include "codegen/certificate/certificate_head.hpp"
#include "codegen/certificate/proof_status.hpp"
#include "codegen/certificate/verify_file.hpp"
#include "codegen/command/interrupt.hpp"
#include "codegen/command/report_options.hpp"
#include "codegen/page/page_data.hpp"
#include "codegen/page/page_template.hpp"

namespace regulus::inline command {

/// A proof or a paving beyond this size stays out of the page.
inline constexpr std::size_t kLongestProof = std::size_t{4} << 20;

class PageRun {
 public:
  /// `typed`: the command line. Both must outlive this.
  PageRun(const ReportCommand& command, const std::string& typed);

  /// Takes the findings of `command.from`, and runs what else is asked: a check unless they have a
  /// verdict.
  ///
  /// Throws    as the runs; InputError and FileError for a file of an earlier run that is about
  ///           another question, and for a certificate that is not verified now.
  void run();

  [[nodiscard]] PageTexts texts() const;
  /// Returns the report of check, with the file of the page.
  [[nodiscard]] nlohmann::ordered_json json_report(const std::string& page) const;
  /// Returns the exit code of the verdict.
  [[nodiscard]] int end();

 private:
  [[nodiscard]] const std::atomic<bool>& interrupted() const { return interrupt_->requested(); }
  [[nodiscard]] Services services();
  /// Each bracket has a time limit of its own, as `bound` and `margin` have.
  [[nodiscard]] SearchOptions search_of_bracket() const;

  // These read earlier runs (page_from.cpp).
  void take_earlier();
  void take_certificate(const EarlierRun& run);
  void begin_from_certificate(const verifier::Verification& verification,
                              const CertificateHead& head);
  void take_question_of(const EarlierRun& run, const CertificateHead& head);
  void take_report(const EarlierRun& run);
  void take_paving(const EarlierRun& run);

  // New runs (page_run.cpp).
  void check();
  void take_proof(const ProofStatus& proof);
  void pave();
  void bound(const std::string& quantity);
  void bracket(const std::string& margin);

  const ReportCommand& command_;
  const std::string& typed_;
  ModelOptions model_;  ///< with the question of the earlier runs
  std::optional<Request> request_;
  std::optional<InterruptGuard> interrupt_;
  std::unique_ptr<CheckAnswer> check_;
  std::string text_;  ///< the report for people
  PageData data_;
};

}  // namespace regulus::command
