// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "codegen/certificate/certificate_file.hpp"
#include "codegen/command/answer.hpp"
#include "codegen/command/command_files.hpp"
#include "codegen/command/commands.hpp"
#include "codegen/command/end_command.hpp"
#include "codegen/command/interrupt.hpp"
#include "codegen/command/lines_file.hpp"
#include "codegen/engine/paving_verdict.hpp"
#include "codegen/engine/search_run.hpp"
#include "codegen/engine/settings.hpp"
#include "codegen/picture/pictures.hpp"
#include "codegen/report/paving_options.hpp"
#include "codegen/report/paving_report.hpp"
#include "codegen/report/paving_writer.hpp"
#include "codegen/report/progress.hpp"
#include "codegen/report/report_text.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/certificate/format.hpp"
#include "runtime/problem/observers.hpp"
#include "runtime/search/workspace.hpp"

namespace regulus::inline command {
namespace {

std::vector<OutputFile> outputs_of(const LocateCommand& command) {
  std::vector<OutputFile> outputs = {
      {"--certificate", command.certificate, true, format::kShardsEnding}};
  if (command.lines != "-") outputs.push_back({"--output", command.lines});
  outputs.push_back(checkpoint_file(command.checkpoint.path));
  for (const std::string& picture : command.pictures.files)
    outputs.push_back({"--picture", picture});
  return outputs;
}

std::vector<Observer*> present(std::initializer_list<Observer*> observers,
                               std::vector<Observer*> result) {
  for (Observer* observer : observers)
    if (observer != nullptr) result.push_back(observer);
  return result;
}

/// Returns after the report and all files are written.
Result pave_and_report(const LocateCommand& command, PreparedSearch& preparation,
                       InterruptGuard& interrupt) {
  const PavingOptions options = resolve_paving(command.resolution, command.search, preparation);
  LinesFile lines(command);
  Pictures pictures(command.pictures, options, preparation);
  std::optional<PavingWriter> writer;
  if (lines.wanted())
    writer.emplace(lines.stream(), preparation, options, [&interrupt] { interrupt.request(); });
  const Problem problem = preparation.problem();
  Volumes volumes(problem, preparation.labels.reach);
  CertificateFile certificate(command.certificate, preparation, std::nullopt, command.shard_size);
  SearchDisplay display(command.output);
  Observers observers(
      present({&volumes, writer ? &*writer : nullptr, certificate.observer(), display.observer()},
              pictures.observers()));

  Settings settings = settings_of(preparation, command.search, &interrupt.requested());
  require_paving(options, settings);
  interrupt.begin_search();
  Result result = run_search(preparation, command.search, settings, &observers);
  close_in_on_witness(preparation, command.search, settings, result);
  if (problem.kernel->constraints > 0)
    volumes.set_workspace(
        measure_workspace(problem, volumes, options.resolution, interrupt.requested()));
  keep_poses_out_of_reach(preparation, volumes, result);

  certificate.finish(result);
  auto summary = json_paving_summary(preparation, command.search, options, volumes, result);
  certificate.status().add_to(summary);
  if (writer) writer->finish(summary, lines.name());
  lines.finish();
  pictures.draw(volumes);
  if (!command.output.quiet)
    print_report(paving_report(preparation, command.search, options, volumes, result) +
                 certificate.status().line());
  if (command.output.json)
    std::cout << report_text(summary, command.output.json_indent) << '\n';
  else if (!lines.is_standard_output())
    print_answer(name(result.verdict), exit_code_of(result.verdict));
  else if (!command.output.quiet)
    std::cerr << name(result.verdict) << '\n';
  return result;
}

}  // namespace

int run_locate(const LocateCommand& command) {
  for (const std::string& picture : command.pictures.files) require_picture_format(picture);
  set_earlier_outputs_aside(input_files(command.model, command.search), outputs_of(command));
  if (const std::optional<int> code = run_force_locate(command)) return *code;
  if (!command.checkpoint.path.empty())
    throw UsageError(
        "--checkpoint: `regulus locate` cannot be continued without --load; the output of a paving "
        "that was stopped lists the boxes it did not reach");
  if (const std::optional<int> code = run_trajectory_locate(command)) return *code;
  InterruptGuard interrupt;
  // A certificate is about all poses of the motion.
  ModelOptions model = command.model;
  model.separates_reach = command.certificate.empty();
  PreparedSearch preparation =
      prepare(model, command.search, forming_watch(command.output, &interrupt.requested()));
  const Result result = pave_and_report(command, preparation, interrupt);
  return end_command(preparation, command.output, result, interrupt.requested());
}

}  // namespace regulus::command
