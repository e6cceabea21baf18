// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <iostream>

#include "regulus/certificate/verifier/verify.hpp"
#include "regulus/codegen/driver/commands.hpp"
#include "regulus/codegen/model/errors.hpp"
#include "regulus/codegen/model/model_file.hpp"

namespace regulus::codegen {
namespace {

verifier::Verification verify_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError("cannot read " + path);
  try {
    return verifier::verify(file);
  } catch (const std::runtime_error& error) {
    throw FileError(path + ": " + error.what());
  }
}

/// A proof about another file than the one that was asked about is of no use.
void require_model(verifier::Verification& verification, const std::string& path) {
  if (path.empty() || load_model(path).sha256 == verification.sha256) return;
  verification.outcome = verifier::Outcome::kRejected;
  verification.reason = "the certificate is not about " + path + ", whose SHA-256 is another" +
                        (verification.reason.empty() ? "" : "; " + verification.reason);
}

}  // namespace

int run_verify(const VerifyCommand& command) {
  verifier::Verification verification = verify_file(command.path);
  require_model(verification, command.model);
  if (!command.quiet) std::cerr << verifier::describe(verification);
  std::cout << verifier::name(verification.outcome) << '\n';
  std::cout.flush();
  return static_cast<int>(verification.outcome);
}

}  // namespace regulus::codegen
