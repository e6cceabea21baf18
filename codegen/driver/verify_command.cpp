// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <iostream>

#include "regulus/certificate/verifier/verify.hpp"
#include "regulus/codegen/driver/commands.hpp"
#include "regulus/codegen/model/errors.hpp"

namespace regulus::codegen {

int run_verify(const VerifyCommand& command) {
  std::ifstream file(command.path, std::ios::binary);
  if (!file) throw FileError("cannot read " + command.path);
  const verifier::Verification verification = verifier::verify(file);
  if (!command.quiet) std::cerr << verifier::describe(verification);
  std::cout << verifier::name(verification.outcome) << '\n';
  std::cout.flush();
  return int(verification.outcome);
}

}  // namespace regulus::codegen
