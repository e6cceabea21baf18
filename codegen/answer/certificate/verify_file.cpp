// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/certificate/verify_file.hpp"

#include <memory>
#include <set>

#include "codegen/answer/certificate/certified_model.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/verifier/input_file.hpp"

namespace regulus {
namespace {

/// Returns the places that options have set: "range x", "tolerance base", "alpha".
std::set<std::string> overridden(const std::vector<std::string>& differences) {
  std::set<std::string> result;
  for (const std::string& text : differences)
    result.insert(text.starts_with("alpha ") ? "alpha"
                                             : text.substr(0, text.find(' ', text.find(' ') + 1)));
  return result;
}

verifier::Verification verify_stream(std::istream& file, const std::string& path,
                                     const verifier::Options& options) {
  try {
    return verifier::verify(file, options);
  } catch (const std::runtime_error& error) {
    throw FileError(path + ": " + error.what());
  }
}

/// A proof of another question is rejected without reading it.
verifier::Verification rejected(const CertificateHead& head, const std::string& reason) {
  verifier::Verification verification;
  verification.outcome = verifier::Outcome::kRejected;
  verification.reason = reason;
  verification.model = head.value("model");
  verification.sha256 = head.value("sha256");
  verification.motion = head.value("motion");
  return verification;
}

std::string joined(const std::vector<std::string>& differences) {
  std::string text;
  for (const std::string& difference : differences) text += (text.empty() ? "" : ", ") + difference;
  return text;
}

std::unique_ptr<verifier::InputFile> opened(const std::string& path) try {
  return std::make_unique<verifier::InputFile>(path);
} catch (const std::runtime_error& error) {
  throw FileError(error.what());
}

}  // namespace

Verified verify_file(const VerificationRequest& request) {
  const auto bytes = opened(request.path);
  std::istream file(bytes.get());
  verifier::Options options = request.options;
  options.path = request.path;
  if (request.model.empty()) return {verify_stream(file, request.path, options), {}};
  const CertificateHead head(file);
  ContinuedText text(head.text(), file);
  std::istream certificate(&text);
  // The verifier reports a file without a head.
  ModelConfirmation confirmation;
  if (!head.lines().empty()) confirmation = confirm_model(head, request.model, request.waypoints);
  if (!confirmation.refusal.empty()) return {rejected(head, confirmation.refusal), {}};
  if (!confirmation.differences.empty() && !request.allows_options)
    return {rejected(head, "the certificate is not about " + request.model +
                               " as it stands: it has " + joined(confirmation.differences) +
                               "; the option allow-options takes what options have changed"),
            confirmation.differences};
  options.model_text = read_model_text(request.model);
  options.model_name = request.model;
  options.overridden = overridden(confirmation.differences);
  options.waypoints = request.waypoints;
  // The way-points take the place of the motion's own poses; they were compared above.
  if (!request.waypoints.empty()) options.all_overridden = true;
  return {verify_stream(certificate, request.path, options), confirmation.differences};
}

}  // namespace regulus
