// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/command/load_option.hpp"

#include <CLI/CLI.hpp>

#include "codegen/answer/refusals.hpp"

namespace regulus::detail {
namespace {

void refuse_foreign_options(const CLI::App& app) {
  if (app.count("--load") == 0) return;
  for (const OptionRefusal& refused : option_refusals_of_loads()) {
    const std::string name = "--" + std::string(refused.option);
    const CLI::Option* given = app.get_option_no_throw(name);
    if (given != nullptr && given->count() > 0)
      throw CLI::ValidationError(name, std::string(refused.why));
  }
}

}  // namespace

void add_load_option(CLI::App& app, std::optional<std::string>& load) {
  app.add_option("--load", load,
                 "Ask instead whether the motors hold every wrench of [load.NAME] with forces "
                 "within [actuators] force, at every pose: FEASIBLE, INFEASIBLE or POSSIBLE "
                 "PROBLEM")
      ->type_name("NAME");
  app.callback([&app] { refuse_foreign_options(app); });
}

}  // namespace regulus::detail
