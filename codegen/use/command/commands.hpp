// SPDX-License-Identifier: GPL-3.0-or-later
// The commands. Each prints its result and returns the exit code.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "codegen/use/command/command_line.hpp"
#include "runtime/verifier/verify.hpp"

namespace regulus::detail {

/// `typed`: the command line as typed, for the page.
[[nodiscard]] int run_report(const ReportCommand& command, const std::string& typed);

/// The part of an index that this process proves, if several share the work.
struct VerifiedPart {
  std::size_t number = 0, count = 1;
  /// As verifier::Options::exchange.
  std::function<void(std::vector<verifier::ShardProof>&)> exchange;
};
[[nodiscard]] int run_verify(const VerifyCommand& command, const VerifiedPart& part = {});
/// Proves a part of an index for another process; prints nothing. Throws FileError.
void prove_part(const VerifyCommand& command, const VerifiedPart& part);

[[nodiscard]] int run_import(const ImportCommand& command);
/// Lists on standard output.
[[nodiscard]] int run_list(const ListCommand& command);

/// `typed`: the command line as typed, for the header of generated text.
[[nodiscard]] int run_explain(const ExplainCommand& command, const std::string& typed);

/// `typed`: the same.
[[nodiscard]] int run_generate(const GenerateCommand& command, const std::string& typed);

}  // namespace regulus::detail
