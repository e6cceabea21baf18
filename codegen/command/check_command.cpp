// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <nlohmann/json.hpp>

#include "codegen/analysis/least_singular.hpp"
#include "codegen/certificate/certificate_file.hpp"
#include "codegen/command/answer.hpp"
#include "codegen/command/command_files.hpp"
#include "codegen/command/commands.hpp"
#include "codegen/command/end_command.hpp"
#include "codegen/command/interrupt.hpp"
#include "codegen/engine/checkpoint_file.hpp"
#include "codegen/engine/search_run.hpp"
#include "codegen/engine/settings.hpp"
#include "codegen/report/progress.hpp"
#include "codegen/report/report.hpp"
#include "codegen/report/report_text.hpp"
#include "runtime/certificate/format.hpp"
#include "runtime/problem/observers.hpp"

namespace regulus::inline command {
namespace {

/// Returns after the report and all files are written.
Result search_and_report(const CheckCommand& command, PreparedSearch& preparation,
                         InterruptGuard& interrupt) {
  const Settings settings = settings_of(preparation, command.search, &interrupt.requested());
  interrupt.begin_search();
  CheckpointFile checkpoint(command.checkpoint, preparation, settings);
  CertificateFile certificate(command.certificate, preparation,
                              checkpoint.partial(command.certificate), command.shard_size);
  // The certificate comes first, so that its bytes are safe before a checkpoint refers to them.
  std::vector<Observer*> watching;
  if (certificate.observer() != nullptr) watching.push_back(certificate.observer());
  if (Observer* saving = checkpoint.observer(certificate.file())) watching.push_back(saving);
  SearchDisplay display(command.output);
  if (display.observer() != nullptr) watching.push_back(display.observer());
  Observers observers(std::move(watching));
  Result result = run_search(preparation, command.search, settings, &observers, checkpoint.found());
  certificate.finish(result);
  checkpoint.finish(result, certificate.file());
  const auto nearest = nearest_singular(preparation, result);
  if (!command.output.quiet)
    print_report(text_report(preparation, command.search, result, nearest) +
                 certificate.status().line() + checkpoint.line());
  if (command.output.json) {
    nlohmann::ordered_json report = json_report(preparation, command.search, result, nearest);
    certificate.status().add_to(report);
    std::cout << report_text(report, command.output.json_indent) << '\n';
  } else {
    print_answer(name(result.verdict), exit_code_of(result.verdict));
  }
  return result;
}

}  // namespace

int run_check(const CheckCommand& command) {
  set_earlier_outputs_aside(input_files(command.model, command.search),
                            {{"--certificate", command.certificate, true, format::kShardsEnding},
                             checkpoint_file(command.checkpoint.path)});
  if (const auto code = run_force_check(command)) return *code;
  if (const auto code = run_trajectory_check(command)) return *code;
  InterruptGuard interrupt;
  PreparedSearch preparation =
      prepare(command.model, command.search, forming_watch(command.output, &interrupt.requested()));
  const Result result = search_and_report(command, preparation, interrupt);
  return end_command(preparation, command.output, result, interrupt.requested());
}

}  // namespace regulus::command
