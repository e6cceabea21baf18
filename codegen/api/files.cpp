// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/api/files.hpp"

#include <nlohmann/json.hpp>

#include "codegen/api/algebra_lock.hpp"
#include "codegen/certificate/verification_report.hpp"
#include "codegen/model/model_file.hpp"
#include "codegen/model/read_file.hpp"
#include "codegen/model/request.hpp"
#include "codegen/report/model_report.hpp"

namespace regulus::inline api {

Confirmation verify(const VerificationRequest& request) {
  const AlgebraLock lock;
  const Verified verified = verify_file(request);
  // Labels are untrusted bytes.
  return {verified.verification.outcome, verified.verification.claim, verified.verification.reason,
          json_verification(request, verified)
              .dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace)};
}

Imported import_file(const std::string& path, const ImportOptions& options) {
  const AlgebraLock lock;
  return import_robot(read_file(path, kLargestImport, Readable::kStream), path, options);
}

std::string describe_model(const Question& question) {
  const AlgebraLock lock;
  const ModelOptions& options = question.options();
  Model model = parse_model(model_text(options), options.path);
  model.path = options.path;
  return json_model(model).dump();
}

}  // namespace regulus::api
