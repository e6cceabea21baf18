// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/command/command_line.hpp"

#include <algorithm>
#include <iostream>

#include "codegen/command/command_tables.hpp"
#include "codegen/command/error_report.hpp"
#include "codegen/command/help_layout.hpp"
#include "codegen/engine/ingredients.hpp"
#include "codegen/support/exit_code.hpp"

namespace regulus::inline command {
namespace {

/// Finds "{a,b,c}" in the text of --help about an option's value.
std::vector<std::string> choices_in(const std::string& type) {
  const std::size_t open = type.find('{'), close = type.find('}');
  std::vector<std::string> choices;
  if (open == std::string::npos || close == std::string::npos) return choices;
  for (std::size_t begin = open + 1; begin < close;) {
    const std::size_t end = std::min(type.find(',', begin), close);
    choices.push_back(type.substr(begin, end - begin));
    begin = end + 1;
  }
  return choices;
}

OptionEntry entry_of(const CLI::Option& option) {
  OptionEntry entry;
  entry.name = option.get_positional() ? option.get_name(true) : option.get_name(false);
  const bool flag = option.get_expected_min() == 0 && option.get_type_size() == 0;
  const std::string type = option.get_type_name();
  entry.choices = choices_in(type);
  if (!flag && !option.get_positional())
    entry.value = entry.choices.empty() ? without_check(type) : "CHOICE";
  if (entry.name == "--without") entry.choices = ingredient_names();
  entry.description = option.get_description();
  entry.required = option.get_required();
  if (!option.get_positional()) entry.group = option.get_group();
  return entry;
}

CommandEntry entry_of(const CLI::App& app, const std::string& name) {
  CommandEntry entry{name, app.get_description(), app.get_footer(), examples_of(name), {}, {}};
  // An option without a group is refused with a message of its own; help does not show it.
  for (const CLI::Option* option : app.get_options())
    if (option->get_positional() || !option->get_group().empty())
      (option->get_positional() ? entry.arguments : entry.options).push_back(entry_of(*option));
  return entry;
}

}  // namespace

CommandLine parse_command_line(int argc, const char* const* argv,
                               const std::string& shell_commands) {
  CommandTables tables(shell_commands);
  CommandLine result;
  try {
    tables.app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    result.exit_code = tables.app.exit(error) == 0 ? 0 : kUsageError;
    if (result.exit_code != 0 && error_format(argc, argv) == ErrorFormat::kJson)
      std::cout << json_error(error, kUsageError) << std::endl;
    return result;
  }
  if (tables.check_command->parsed()) result.check = tables.check;
  if (tables.locate_command->parsed()) result.locate = tables.locate;
  if (tables.margin_command->parsed()) result.margin = tables.margin;
  if (tables.bound_command->parsed()) result.bound = tables.bound;
  if (tables.datasheet_command->parsed()) result.datasheet = tables.datasheet;
  if (tables.report_command->parsed()) result.report = tables.report;
  if (tables.explain_command->parsed()) result.explain = tables.explain;
  if (tables.generate_command->parsed()) result.generate = tables.generate;
  if (tables.verify_command->parsed()) result.verify = tables.verify;
  if (tables.import_command->parsed()) result.import = tables.import;
  if (tables.list_command->parsed()) result.list = tables.list;
  if (tables.shell_command->parsed()) result.shell = tables.shell;
  return result;
}

std::string help_of(const std::string& command) {
  const CommandTables tables("");
  for (const CLI::App* one : tables.app.get_subcommands(nullptr))
    if (one->get_name() == command) return one->help("regulus");
  return "";
}

std::vector<CommandEntry> command_table(const std::string& shell_commands) {
  const CommandTables tables(shell_commands);
  std::vector<CommandEntry> table{entry_of(tables.app, "")};
  for (const CLI::App* command : tables.app.get_subcommands(nullptr))
    table.push_back(entry_of(*command, command->get_name()));
  return table;
}

}  // namespace regulus::command
