// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/api/files.hpp"

#include <nlohmann/json.hpp>

#include "codegen/answer/certificate/verification_report.hpp"
#include "codegen/answer/report/model_report.hpp"
#include "codegen/answer/report/report_text.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/model/file/read_file.hpp"
#include "codegen/model/request.hpp"
#include "codegen/use/api/algebra_lock.hpp"

namespace regulus {

using namespace detail;

namespace {

ProofOutcome outcome_of(const verifier::Verification& verification) {
  switch (verification.outcome) {
    case verifier::Outcome::kVerified:
      return ProofOutcome::kVerified;
    case verifier::Outcome::kRejected:
      return ProofOutcome::kRejected;
    case verifier::Outcome::kUnfinished:
      break;
  }
  return ProofOutcome::kUnfinished;
}

}  // namespace

Confirmation verify(const std::string& path, const VerifyOptions& options) {
  const AlgebraLock lock;
  VerificationRequest request{path, options.model, options.waypoints, options.allow_options, {}};
  request.options.threads = options.threads;
  request.options.time_limit = options.time_limit;
  if (options.max_boxes > 0) request.options.max_boxes = options.max_boxes;
  const verifier::Verification verification = verify_file(request);
  // Labels are untrusted bytes.
  return {outcome_of(verification), verification.claim, verification.reason,
          report_text(json_verification(request, verification), 2)};
}

Imported import_file(const std::string& path, const ImportOptions& options) {
  const AlgebraLock lock;
  return import_robot_file(path, options);
}

std::string describe_model(const Question& question) {
  const AlgebraLock lock;
  const ModelOptions& options = question.options();
  Model model = parse_model(model_text(options), options.path);
  model.path = options.path;
  return report_text(json_model(model));
}

}  // namespace regulus
