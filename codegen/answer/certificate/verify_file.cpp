// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/certificate/verify_file.hpp"

#include <memory>

#include "codegen/model/file/model_file.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/verifier/input_file.hpp"

namespace regulus::detail {
namespace {

std::unique_ptr<verifier::InputFile> opened(const std::string& path) try {
  return std::make_unique<verifier::InputFile>(path);
} catch (const std::runtime_error& error) {
  throw FileError(error.what());
}

}  // namespace

verifier::Verification verify_file(const VerificationRequest& request) {
  const auto bytes = opened(request.path);
  std::istream file(bytes.get());
  verifier::Options options = request.options;
  options.path = request.path;
  if (!request.model.empty()) {
    options.model_text = read_model_text(request.model);
    // Says where a file is wrong that is no model.
    static_cast<void>(parse_model(options.model_text, request.model));
    options.model_name = request.model;
    options.waypoints = request.waypoints;
    options.all_overridden = request.allows_options;
  }
  try {
    return verifier::verify(file, options);
  } catch (const std::runtime_error& error) {
    throw FileError(request.path + ": " + error.what());
  }
}

}  // namespace regulus::detail
