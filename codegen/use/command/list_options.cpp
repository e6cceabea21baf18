// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/command/list_options.hpp"

#include <CLI/CLI.hpp>

namespace regulus::detail {

void add_list_options(CLI::App& app, ListCommand& command) {
  app.add_option("MODEL", command.path,
                 "Show the motions of this model with their ranges, and its groups with their "
                 "tolerances; without MODEL, list the installed models");
  app.add_flag("--json", command.json, "Print one JSON object on standard output");
  app.add_flag("--quiet", command.quiet,
               "Print only the names of the models, or of the motions (or the JSON object)");
}

}  // namespace regulus::detail
