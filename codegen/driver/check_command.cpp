// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <nlohmann/json.hpp>

#include "regulus/codegen/driver/always_singular.hpp"
#include "regulus/codegen/driver/commands.hpp"
#include "regulus/codegen/driver/interrupt.hpp"
#include "regulus/codegen/driver/report.hpp"
#include "regulus/codegen/driver/search_run.hpp"
#include "regulus/codegen/driver/settings.hpp"

namespace regulus::codegen {

int run_check(const CheckCommand& command) {
  const InterruptGuard interrupt;
  Preparation preparation = prepare(command.model, command.search);
  Settings settings = settings_from(command.search);
  settings.interrupt = &interrupt.requested();
  for (const FilterFile& filter : preparation.filters)
    settings.filters.push_back(&filter.interface());
  Result result = run_search(preparation, command.search, command.output, settings);
  recognise_always_singular(preparation, result);
  if (!command.output.quiet) std::cerr << text_report(preparation, command.search, result);
  if (command.output.json)
    std::cout << json_report(preparation, command.search, result).dump(2) << '\n';
  else
    std::cout << name(result.verdict) << '\n';
  std::cout.flush();
  return exit_code_of(result.verdict);
}

}  // namespace regulus::codegen
