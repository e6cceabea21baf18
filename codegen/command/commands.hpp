// SPDX-License-Identifier: GPL-3.0-or-later
// The commands. Each prints its result and returns the exit code.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "codegen/command/command_line.hpp"
#include "codegen/margin/margin_run.hpp"
#include "runtime/certificate/verifier/verify.hpp"

namespace regulus::inline command {

[[nodiscard]] int run_check(const CheckCommand& command);

/// Runs the check if its motion is along way-points; otherwise returns nullopt.
[[nodiscard]] std::optional<int> run_trajectory_check(const CheckCommand& command);

[[nodiscard]] int run_locate(const LocateCommand& command);

/// Does the same if its motion is along way-points; otherwise returns nullopt.
[[nodiscard]] std::optional<int> run_trajectory_locate(const LocateCommand& command);

/// Runs the check or the paving if it is about forces that hold a load; otherwise returns nullopt.
[[nodiscard]] std::optional<int> run_force_check(const CheckCommand& command);
[[nodiscard]] std::optional<int> run_force_locate(const LocateCommand& command);

[[nodiscard]] int run_margin(const MarginCommand& command);

/// Returns the exit code of a bracket.
[[nodiscard]] int exit_code_of_margin(const MarginQuestion& question, const Margin& margin);

/// Runs the margin if it is that of a limit; otherwise returns nullopt.
[[nodiscard]] std::optional<int> run_limit_margin(const MarginCommand& command);

/// Runs the margin of a motion along way-points. `command`: without the option of `question`.
[[nodiscard]] int run_trajectory_margin(const MarginCommand& command,
                                        const MarginQuestion& question, Request request);

[[nodiscard]] int run_bound(const BoundCommand& command);

/// `typed`: the command line as typed, for the page.
[[nodiscard]] int run_report(const ReportCommand& command, const std::string& typed);

[[nodiscard]] int run_datasheet(const DatasheetCommand& command);

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

}  // namespace regulus::command
