// SPDX-License-Identifier: GPL-3.0-or-later
// `regulus check --load NAME` and `regulus locate --load NAME`.
#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "codegen/bound/bound_run.hpp"
#include "codegen/command/answer.hpp"
#include "codegen/command/commands.hpp"
#include "codegen/command/interrupt.hpp"
#include "codegen/command/lines_file.hpp"
#include "codegen/engine/refusals.hpp"
#include "codegen/feasibility/feasibility_report.hpp"
#include "codegen/feasibility/force_certificate.hpp"
#include "codegen/feasibility/way_forces.hpp"
#include "codegen/report/paving_options.hpp"
#include "codegen/report/progress.hpp"
#include "codegen/report/report_text.hpp"
#include "codegen/support/earlier_outputs.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/exit_code.hpp"
#include "codegen/support/stopwatch.hpp"
#include "codegen/trajectory/read_trajectory.hpp"
#include "runtime/problem/observers.hpp"

namespace regulus::inline command {
namespace {

int exit_code_of(FeasibilityVerdict verdict) {
  switch (verdict) {
    case FeasibilityVerdict::kFeasible:
      return kNoSingularity;
    case FeasibilityVerdict::kInfeasible:
      return kSingularity;
    case FeasibilityVerdict::kPossibleProblem:
      return kPossibleProblem;
  }
  return kInternalFault;
}

/// Prints the report and the verdict. `to_error`: standard output has the boxes.
int print_forces(const PreparedForces& prepared, const FeasibilityResult& result,
                 const ForceVolumes* volumes, const ForceCertificate& certificate,
                 const ForceCheckpoint& checkpoint, const OutputOptions& output, bool to_error) {
  const int code = exit_code_of(result.verdict);
  if (!output.quiet)
    print_report(format_forces(prepared, result, volumes) + certificate.status().line() +
                 checkpoint.line());
  if (output.json) {
    nlohmann::ordered_json report = json_forces(prepared, result, volumes);
    certificate.status().add_to(report);
    std::cout << report_text(report, output.json_indent) << '\n';
  } else if (!to_error) {
    print_answer(name(result.verdict), code);
  } else if (!output.quiet) {
    std::cerr << name(result.verdict) << '\n';
  }
  std::cout.flush();
  return code;
}

/// Searches with a display and a certificate.
FeasibilityResult search_and_certify(PreparedForces& prepared, const FeasibilitySettings& settings,
                                     const ForceListener& listener, ForceCertificate& certificate,
                                     ForceCheckpoint& checkpoint, const OutputOptions& output) {
  SearchDisplay display(output);
  std::vector<Observer*> watching;
  for (Observer* observer : {certificate.observer(), display.observer()})
    if (observer != nullptr) watching.push_back(observer);
  Observers observers(std::move(watching));
  FeasibilityResult result = run_forces(prepared, settings, listener, &observers, &checkpoint);
  certificate.finish(result);
  return result;
}

int check_along_way(const CheckCommand& command, Request request, double model_seconds) {
  refuse_option(Asked::kPathCheck, "checkpoint", !command.checkpoint.path.empty());
  InterruptGuard interrupt;
  interrupt.begin_search();
  const std::string& path = command.certificate;
  SearchDisplay display(command.output);
  const WayForces found =
      check_forces_along_way(std::move(request), model_seconds, *command.load, command.search,
                             !path.empty(), &interrupt.requested(), display.observer());
  const ProofStatus certificate = certify_way_forces(path, found);
  if (!command.output.quiet) print_report(format_way_forces(found) + certificate.line());
  const int code = exit_code_of(found.verdict);
  if (command.output.json) {
    nlohmann::ordered_json report = json_way_forces(found);
    certificate.add_to(report);
    std::cout << report_text(report, command.output.json_indent) << '\n';
  } else {
    print_answer(name(found.verdict), code);
  }
  std::cout.flush();
  return code;
}

/// Paves the variety; returns the exit code.
int pave_forces(const LocateCommand& command, PreparedForces& prepared, InterruptGuard& interrupt) {
  const PavingOptions options =
      resolve_paving(command.resolution, prepared.search, prepared.preparation);
  LinesFile lines(command);
  const auto write = [&](const nlohmann::ordered_json& line) {
    if (!lines.wanted()) return;
    lines.stream() << report_text(line) << '\n';
    if (!lines.stream()) interrupt.request();
  };
  ForceVolumes volumes(prepared.problem);
  ForceCertificate certificate(command.certificate, prepared, true);
  FeasibilitySettings settings = settings_of(prepared, &interrupt.requested());
  settings.paves = true;
  settings.min_relative_width = options.resolution;
  ForceCheckpoint checkpoint(command.checkpoint, prepared, settings);
  interrupt.begin_search();
  write(json_forces_header(prepared, options.resolution));
  const FeasibilityResult result = search_and_certify(
      prepared, settings,
      [&](std::span<const Interval> box, ForceClaim claim) {
        volumes.add(box, claim);
        write(json_forces_box(prepared, box, claim));
      },
      certificate, checkpoint, command.output);
  write(json_forces(prepared, result, &volumes));
  lines.finish();
  return print_forces(prepared, result, &volumes, certificate, checkpoint, command.output,
                      lines.is_standard_output());
}

}  // namespace

std::optional<int> run_force_check(const CheckCommand& command) {
  if (!command.load) return std::nullopt;
  Stopwatch watch;
  if (std::optional<Request> request = read_trajectory(command.model))
    return check_along_way(command, std::move(*request), watch.lap());
  InterruptGuard interrupt;
  PreparedForces prepared = prepare_forces(command.model, *command.load, command.search,
                                           forming_watch(command.output, &interrupt.requested()));
  ForceCertificate certificate(command.certificate, prepared, false);
  const FeasibilitySettings settings = settings_of(prepared, &interrupt.requested());
  ForceCheckpoint checkpoint(command.checkpoint, prepared, settings);
  interrupt.begin_search();
  const FeasibilityResult result = search_and_certify(
      prepared, settings, [](std::span<const Interval>, ForceClaim) {}, certificate, checkpoint,
      command.output);
  return print_forces(prepared, result, nullptr, certificate, checkpoint, command.output, false);
}

std::optional<int> run_force_locate(const LocateCommand& command) {
  if (!command.load) return std::nullopt;
  InterruptGuard interrupt;
  PreparedForces prepared = prepare_forces(command.model, *command.load, command.search,
                                           forming_watch(command.output, &interrupt.requested()));
  return pave_forces(command, prepared, interrupt);
}

}  // namespace regulus::command
