// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "codegen/certificate/certified_model.hpp"
#include "codegen/command/commands.hpp"
#include "codegen/model/model_file.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/certificate/verifier/input_file.hpp"
#include "runtime/certificate/verifier/verify.hpp"

namespace regulus::inline command {
namespace {

using verifier::Outcome;
using verifier::Verification;

struct Verified {
  Verification verification;
  std::vector<std::string> differences;  ///< from the model file of --model
};

/// Rewrites one line on a terminal.
void show_progress(const Verification& v) {
  std::cerr << "\r\033[K" << v.leaves << " leaves, " << v.boxes << " boxes" << std::flush;
}

verifier::Options options_of(const VerifyCommand& command, const VerifiedPart& part) {
  verifier::Options options;
  options.time_limit = command.time_limit.value_or(0);
  options.max_boxes = command.max_boxes.value_or(options.max_boxes);
  options.threads = command.threads;
  options.path = command.path;
  options.part = part.number;
  options.parts = part.count;
  options.exchange = part.exchange;
  if (!command.output.quiet && !command.output.json && isatty(STDERR_FILENO) != 0)
    options.progress = show_progress;
  return options;
}

/// Returns the places that options have set: "range x", "tolerance base", "alpha".
std::set<std::string> overridden(const std::vector<std::string>& differences) {
  std::set<std::string> result;
  for (const std::string& text : differences)
    result.insert(text.starts_with("alpha ") ? "alpha"
                                             : text.substr(0, text.find(' ', text.find(' ') + 1)));
  return result;
}

Verification verify_stream(std::istream& file, const std::string& path,
                           const verifier::Options& options) {
  try {
    const Verification result = verifier::verify(file, options);
    if (options.progress) std::cerr << "\r\033[K";
    return result;
  } catch (const std::runtime_error& error) {
    throw FileError(path + ": " + error.what());
  }
}

/// A proof of another question is rejected without reading it.
Verification rejected(const CertificateHead& head, const std::string& reason) {
  Verification verification;
  verification.outcome = Outcome::kRejected;
  verification.reason = reason;
  verification.model = head.value("model");
  verification.sha256 = head.value("sha256");
  verification.motion = head.value("motion");
  return verification;
}

std::unique_ptr<verifier::InputFile> opened(const std::string& path) try {
  return std::make_unique<verifier::InputFile>(path);
} catch (const std::runtime_error& error) {
  throw FileError(error.what());
}

Verified verify_file(const VerifyCommand& command, const VerifiedPart& part) {
  const auto bytes = opened(command.path);
  std::istream file(bytes.get());
  verifier::Options options = options_of(command, part);
  if (command.model.empty()) return {verify_stream(file, command.path, options), {}};
  const CertificateHead head(file);
  ContinuedText text(head.text(), file);
  std::istream certificate(&text);
  // The verifier reports a file without a head.
  ModelConfirmation confirmation;
  if (!head.lines().empty()) confirmation = confirm_model(head, command.model, command.waypoints);
  if (!confirmation.refusal.empty()) return {rejected(head, confirmation.refusal), {}};
  options.model_text = read_model_text(command.model);
  options.model_name = command.model;
  options.overridden = overridden(confirmation.differences);
  // The way-points take the place of the motion's own poses; they were compared above.
  if (!command.waypoints.empty()) options.all_overridden = true;
  return {verify_stream(certificate, command.path, options), confirmation.differences};
}

std::string model_lines(const VerifyCommand& command, const Verified& verified) {
  if (command.model.empty() || verified.verification.outcome == Outcome::kRejected) return "";
  std::string lines = "question   that of " + command.model;
  const char* begin = ", with ";
  for (const std::string& difference : verified.differences) {
    lines += begin + difference;
    begin = ", ";
  }
  return lines + '\n';
}

const char* json_name(Outcome outcome) {
  return outcome == Outcome::kVerified   ? "verified"
         : outcome == Outcome::kRejected ? "rejected"
                                         : "unfinished";
}

nlohmann::ordered_json json_report(const VerifyCommand& command, const Verified& verified) {
  const Verification& v = verified.verification;
  nlohmann::ordered_json report = {{"outcome", json_name(v.outcome)},
                                   {"reason", v.reason},
                                   {"claim", v.claim},
                                   {"model", v.model},
                                   {"model_sha256", v.sha256},
                                   {"motion", v.motion},
                                   {"shards", v.shards},
                                   {"leaves", v.leaves},
                                   {"boxes", v.boxes},
                                   {"note", v.note}};
  report["certificate"] = command.path;
  report["model_file"] = nullptr;
  if (!command.model.empty()) report["model_file"] = command.model;
  report["differences"] = verified.differences;
  report["numbers_compared"] = v.numbers;
  report["uncompared"] = v.uncompared;
  return report;
}

}  // namespace

void prove_part(const VerifyCommand& command, const VerifiedPart& part) {
  static_cast<void>(verify_file(command, part));
}

int run_verify(const VerifyCommand& command, const VerifiedPart& part) {
  const Verified verified = verify_file(command, part);
  const Verification& verification = verified.verification;
  if (!command.output.quiet)
    std::cerr << verifier::describe(verification) << model_lines(command, verified);
  if (command.output.json)
    // Labels are untrusted bytes.
    std::cout << json_report(command, verified)
                     .dump(command.output.json_indent, ' ', false,
                           nlohmann::ordered_json::error_handler_t::replace)
              << '\n';
  else
    std::cout << verifier::name(verification.outcome) << '\n';
  std::cout.flush();
  return static_cast<int>(verification.outcome);
}

}  // namespace regulus::command
