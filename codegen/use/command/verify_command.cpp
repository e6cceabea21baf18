// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "codegen/answer/certificate/verification_report.hpp"
#include "codegen/answer/report/report_text.hpp"
#include "codegen/use/command/commands.hpp"
#include "codegen/use/command/terminal.hpp"

namespace regulus::detail {
namespace {

using verifier::Outcome;
using verifier::Verification;

/// Rewrites one line on a terminal.
void show_progress(const Verification& v) {
  std::cerr << "\r\033[K" << v.leaves << " leaves, " << v.boxes << " boxes" << std::flush;
}

VerificationRequest request_of(const VerifyCommand& command, const VerifiedPart& part) {
  VerificationRequest request{
      command.path, command.model, command.waypoints, command.allows_options, {}};
  verifier::Options& options = request.options;
  options.time_limit = command.time_limit.value_or(0);
  options.max_boxes = command.max_boxes.value_or(options.max_boxes);
  options.threads = command.threads;
  options.part = part.number;
  options.parts = part.count;
  options.exchange = part.exchange;
  if (!command.output.quiet && !command.output.json && isatty(STDERR_FILENO) != 0)
    options.progress = show_progress;
  return request;
}

}  // namespace

void prove_part(const VerifyCommand& command, const VerifiedPart& part) {
  static_cast<void>(verify_file(request_of(command, part)));
}

int run_verify(const VerifyCommand& command, const VerifiedPart& part) {
  const VerificationRequest request = request_of(command, part);
  const Verification verification = verify_file(request);
  if (request.options.progress) std::cerr << "\r\033[K";
  const bool is_of_model = !command.model.empty() && verification.outcome == Outcome::kVerified;
  if (!command.output.quiet)
    print_report(verifier::describe(verification) +
                 (is_of_model ? "question   that of " + command.model + '\n' : ""));
  if (command.output.json)
    // Labels are untrusted bytes.
    std::cout << report_text(json_verification(request, verification), command.output.json_indent)
              << '\n';
  else
    print_answer(verifier::name(verification.outcome), static_cast<int>(verification.outcome));
  std::cout.flush();
  return static_cast<int>(verification.outcome);
}

}  // namespace regulus::detail
