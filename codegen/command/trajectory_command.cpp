// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <nlohmann/json.hpp>

#include "codegen/command/answer.hpp"
#include "codegen/command/commands.hpp"
#include "codegen/command/end_command.hpp"
#include "codegen/command/interrupt.hpp"
#include "codegen/command/lines_file.hpp"
#include "codegen/engine/refusals.hpp"
#include "codegen/margin/margin_certificates.hpp"
#include "codegen/margin/margin_report.hpp"
#include "codegen/margin/prepared_margin.hpp"
#include "codegen/report/paving_options.hpp"
#include "codegen/report/report_text.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/stopwatch.hpp"
#include "codegen/trajectory/margin_checkpoint.hpp"
#include "codegen/trajectory/read_trajectory.hpp"
#include "codegen/trajectory/trajectory_certificate.hpp"
#include "codegen/trajectory/trajectory_margin.hpp"
#include "codegen/trajectory/trajectory_paving.hpp"
#include "codegen/trajectory/trajectory_report.hpp"

namespace regulus::inline command {

namespace {

/// Other ranks would wait, while the first one does all the work.
void refuse_ranks(const SearchOptions& search) {
  if (search.workers != nullptr)
    throw UsageError(
        "a motion along way-points is searched on one machine; use regulus, with --threads");
}

void refuse_what_locate_lacks(const LocateCommand& command) {
  refuse_option(Asked::kPathPaving, "certificate", !command.certificate.empty());
  refuse_option(Asked::kPathPaving, "picture",
                !command.pictures.files.empty() || !command.pictures.axes.empty());
}

}  // namespace

std::optional<int> run_trajectory_check(const CheckCommand& command) {
  Stopwatch watch;
  std::optional<Request> request = read_trajectory(command.model);
  if (!request) return std::nullopt;
  refuse_ranks(command.search);
  refuse_option(Asked::kPathCheck, "checkpoint", !command.checkpoint.path.empty());
  refuse_option(Asked::kPathCheck, "shard-size", command.shard_size > 0);
  InterruptGuard interrupt;
  interrupt.begin_search();
  const double model_seconds = watch.lap();
  const TrajectoryCheck check =
      check_trajectory(std::move(*request), model_seconds, command.search,
                       !command.certificate.empty(), &interrupt.requested());
  const ProofStatus certificate = certify_trajectory(command.certificate, check);
  if (!command.output.quiet)
    print_report(format_trajectory(check, command.search) + certificate.line());
  if (command.output.json) {
    nlohmann::ordered_json report = json_trajectory(check, command.search);
    certificate.add_to(report);
    std::cout << report_text(report, command.output.json_indent) << '\n';
  } else {
    print_answer(name(check.verdict), exit_code_of(check.verdict));
  }
  std::cout.flush();
  return exit_code_of(check.verdict);
}

std::optional<int> run_trajectory_locate(const LocateCommand& command) {
  Stopwatch watch;
  // A proof is about all poses; a paving tells those out of reach from the others.
  ModelOptions model = command.model;
  model.separates_reach = true;
  std::optional<Request> request = read_trajectory(model);
  if (!request) return std::nullopt;
  refuse_ranks(command.search);
  refuse_what_locate_lacks(command);
  LinesFile lines(command);
  InterruptGuard interrupt;
  interrupt.begin_search();
  const double model_seconds = watch.lap();
  const PathPaving paving = pave_trajectory(
      std::move(*request), model_seconds, command.search,
      command.resolution.empty() ? kPathResolution : read_resolution(command.resolution),
      &interrupt.requested());
  const nlohmann::ordered_json summary = json_path_paving(paving, command.search);
  if (lines.wanted()) {
    for (const PathStretch& stretch : paving.stretches)
      lines.stream() << report_text(json_stretch(paving, stretch)) << '\n';
    lines.stream() << report_text({{"summary", summary}}) << '\n';
    lines.finish();
  }
  const std::string verdict = std::string(name(paving.check.verdict)) + '\n';
  if (!command.output.quiet) print_report(format_path_paving(paving, command.search));
  if (command.output.json)
    std::cout << report_text(summary, command.output.json_indent) << '\n';
  else if (!lines.is_standard_output() || !command.output.quiet)
    (lines.is_standard_output() ? std::cerr : std::cout) << verdict;
  std::cout.flush();
  return exit_code_of(paving.check.verdict);
}

int run_trajectory_margin(const MarginCommand& command, const MarginQuestion& question,
                          Request request) {
  refuse_ranks(command.search);
  MarginCheckpoint checkpoint(command.checkpoint, request, question, command.search);
  InterruptGuard interrupt;
  interrupt.begin_search();
  const bool quiet = command.output.quiet;
  const double gap = read_gap(command.gap);
  const MarginRequest growing(std::move(request), question);
  HeldFiles held;
  const TrajectoryMargin found = margin_of_trajectory(growing, question, command.search, gap,
                                                      {{},
                                                       &interrupt.requested(),
                                                       [quiet](const MarginStep& step) {
                                                         if (!quiet) std::cerr << format_step(step);
                                                       },
                                                       checkpoint.searches()},
                                                      margin_proofs(command.certificate, &held));
  held.put_in_place();
  if (!quiet)
    print_report(format_trajectory_margin(found, question, command.search) + checkpoint.line());
  if (command.output.json)
    std::cout << report_text(json_trajectory_margin(found, question, command.search, gap),
                             command.output.json_indent)
              << '\n';
  else
    std::cout << describe_bracket(question, found.margin) << '\n';
  std::cout.flush();
  return exit_code_of_margin(question, found.margin);
}

}  // namespace regulus::command
