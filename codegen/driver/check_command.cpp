// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <nlohmann/json.hpp>

#include "regulus/codegen/driver/certificate_file.hpp"
#include "regulus/codegen/driver/checkpoint_file.hpp"
#include "regulus/codegen/driver/commands.hpp"
#include "regulus/codegen/driver/earlier_outputs.hpp"
#include "regulus/codegen/driver/interrupt.hpp"
#include "regulus/codegen/driver/least_singular.hpp"
#include "regulus/codegen/driver/progress.hpp"
#include "regulus/codegen/driver/report.hpp"
#include "regulus/codegen/driver/search_run.hpp"
#include "regulus/codegen/driver/settings.hpp"
#include "regulus/search/observers.hpp"

namespace regulus::codegen {
namespace {

/// Returns when the report and all files are written.
Result search_and_report(const CheckCommand& command, Preparation& preparation,
                         InterruptGuard& interrupt) {
  Settings settings = settings_from(command.search);
  settings.interrupt = &interrupt.requested();
  settings.time_limit = seconds_left(preparation, settings.time_limit);
  interrupt.begin_search();
  for (const FilterFile& filter : preparation.filters)
    settings.filters.push_back(&filter.interface());
  CheckpointFile checkpoint(command.checkpoint, preparation, settings);
  CertificateFile certificate(command.certificate, preparation,
                              checkpoint.partial(command.certificate));
  // The certificate first: what it has is then safe before a checkpoint speaks of it.
  std::vector<Observer*> watching;
  if (certificate.observer() != nullptr) watching.push_back(certificate.observer());
  if (Observer* saving = checkpoint.observer(certificate.writer())) watching.push_back(saving);
  Observers observers(std::move(watching));
  Result result = run_search(preparation, command.search, command.output, settings, &observers,
                             checkpoint.found());
  certificate.finish(result);
  checkpoint.finish(result, certificate.writer());
  const auto nearest = nearest_singular(preparation, result);
  if (!command.output.quiet)
    std::cerr << text_report(preparation, command.search, result, nearest) << certificate.line()
              << checkpoint.line();
  if (command.output.json) {
    nlohmann::ordered_json report = json_report(preparation, command.search, result, nearest);
    certificate.add_to(report);
    std::cout << report.dump(command.output.json_indent) << '\n';
  } else {
    std::cout << name(result.verdict) << '\n';
  }
  return result;
}

}  // namespace

int run_check(const CheckCommand& command) {
  set_earlier_outputs_aside(command.model.path, {{"--certificate", command.certificate, true}});
  InterruptGuard interrupt;
  Preparation preparation =
      prepare(command.model, command.search, forming_watch(command.output, &interrupt.requested()));
  const Result result = search_and_report(command, preparation, interrupt);
  return end_command(preparation, command.output, result, interrupt.requested());
}

}  // namespace regulus::codegen
