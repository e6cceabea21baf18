// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <nlohmann/json.hpp>

#include "regulus/codegen/driver/always_singular.hpp"
#include "regulus/codegen/driver/certificate_file.hpp"
#include "regulus/codegen/driver/commands.hpp"
#include "regulus/codegen/driver/interrupt.hpp"
#include "regulus/codegen/driver/least_singular.hpp"
#include "regulus/codegen/driver/report.hpp"
#include "regulus/codegen/driver/search_run.hpp"
#include "regulus/codegen/driver/settings.hpp"

namespace regulus::codegen {

namespace {

/// Where to look, when all that is known is that no proof was found.
std::optional<LeastSingular> nearest_singular(const Preparation& preparation,
                                              const Result& result) {
  if (result.verdict != Verdict::kPossibleProblem || result.reason == Reason::kUndefined)
    return std::nullopt;
  return approx_least_singular(preparation, result.blocking_box);
}

}  // namespace

int run_check(const CheckCommand& command) {
  const InterruptGuard interrupt;
  Preparation preparation = prepare(command.model, command.search);
  Settings settings = settings_from(command.search);
  settings.interrupt = &interrupt.requested();
  for (const FilterFile& filter : preparation.filters)
    settings.filters.push_back(&filter.interface());
  CertificateFile certificate(command.certificate, preparation);
  Result result =
      run_search(preparation, command.search, command.output, settings, certificate.observer());
  recognise_always_singular(preparation, result);
  certificate.finish(result);
  const auto nearest = nearest_singular(preparation, result);
  if (!command.output.quiet)
    std::cerr << text_report(preparation, command.search, result, nearest) << certificate.line();
  if (command.output.json) {
    nlohmann::ordered_json report = json_report(preparation, command.search, result, nearest);
    certificate.add_to(report);
    std::cout << report.dump(2) << '\n';
  } else {
    std::cout << name(result.verdict) << '\n';
  }
  std::cout.flush();
  return exit_code_of(result.verdict);
}

}  // namespace regulus::codegen
