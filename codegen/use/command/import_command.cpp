// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/report_text.hpp"
#include "codegen/model/import/import.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/use/command/commands.hpp"
#include "codegen/use/command/import_output.hpp"
#include "codegen/use/command/terminal.hpp"

namespace regulus::detail {

namespace {

nlohmann::ordered_json json_of(const Imported& imported, const std::string& output) {
  nlohmann::ordered_json notes = nlohmann::ordered_json::object();
  for (const ImportNotes& about : imported.notes) notes[about.title] = about.lines;
  return {{"file", output.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(output)},
          {"model", imported.model},
          {"notes", notes}};
}

}  // namespace

int run_import(const ImportCommand& command) {
  const Imported imported = import_robot_file(command.path, command.options);
  if (!command.output.empty()) write_imported(command.output, imported.model);
  if (command.json) {
    std::cout << report_text(json_of(imported, command.output)) << std::endl;
    return 0;
  }
  if (!command.quiet) print_report(imported.report());
  if (command.output.empty()) std::cout << imported.model << std::flush;
  return 0;
}

}  // namespace regulus::detail
