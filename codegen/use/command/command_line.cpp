// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/command/command_line.hpp"

#include <algorithm>
#include <array>
#include <iostream>
#include <string_view>

#include "codegen/model/names.hpp"
#include "codegen/question/engine/ingredients.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/exit_code.hpp"
#include "codegen/use/command/command_tables.hpp"
#include "codegen/use/command/error_report.hpp"
#include "codegen/use/command/help_layout.hpp"

namespace regulus::detail {
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

/// Says which other commands have the option; empty: none.
std::string commands_with(const std::string& option, const CLI::App& app) {
  std::string names;
  for (const CLI::App* one : app.get_subcommands(nullptr))
    if (const CLI::Option* found = one->get_option_no_throw(option);
        found != nullptr && !found->get_group().empty())
      names += (names.empty() ? "regulus " : ", regulus ") + one->get_name();
  return names;
}

std::vector<std::string> long_names_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// Returns the error about the first word that is no command or no option; CLI11 only says that
/// something is missing or not expected.
std::optional<UsageError> mistyped_word(const CLI::App& app, int argc, const char* const* argv) {
  const std::string command = argc > 1 ? argv[1] : "-";
  std::vector<std::string> commands, options;
  for (const CLI::App* one : app.get_subcommands(nullptr)) {
    commands.push_back(one->get_name());
    if (one->get_name() == command) options = long_names_of(*one);
  }
  if (options.empty() && !command.starts_with("-"))
    return UsageError("there is no command " + in_quotes(command) + "; " +
                      suggestion(command, commands, "regulus --help lists the commands"));
  for (int i = 2; i < argc && !options.empty(); ++i) {
    const std::string_view word(argv[i]);
    const std::string option(word.substr(0, word.find('=')));
    const bool is_known = std::ranges::find(options, option) != options.end();
    if (!option.starts_with("--") || option.size() == 2 || is_known) continue;
    if (const std::string others = commands_with(option, app); !others.empty())
      return UsageError("regulus " + command + " has no option " + in_quotes(option) +
                        "; it is one of " + others);
    return UsageError("there is no option " + in_quotes(option) + "; " +
                      suggestion(option, options, "regulus " + command + " --help lists them"));
  }
  return std::nullopt;
}

/// Returns the error with what to do about it.
UsageError with_remedy(const CLI::ParseError& error, const CLI::App& app, std::string_view program,
                       const std::string& command) {
  constexpr std::array kOnRanks = {"check",     "locate", "margin", "bound",
                                   "datasheet", "solve",  "verify"};
  const auto commands =
      app.get_subcommands([&command](const CLI::App* one) { return one->get_name() == command; });
  const bool is_command = !commands.empty();
  if (program.ends_with("regulus-mpi") && is_command &&
      std::ranges::find(kOnRanks, command) == kOnRanks.end())
    return UsageError("the command " + command + " does not run on ranks; use regulus " + command);
  std::string what = error.what();
  if (what == "MODEL is required")
    return UsageError(
        what +
        ": the path of a model file, or the name of an installed model, which regulus list shows");
  return UsageError(what + "; regulus " + (is_command ? command + " " : "") + "--help says more");
}

/// Prints help if it was asked for, or if nothing was; otherwise the error. Returns the exit code.
int report_parse_error(const CLI::App& app, const CLI::ParseError& error, int argc,
                       const char* const* argv) {
  if (error.get_exit_code() == 0) return app.exit(error);
  const bool is_json = error_format(argc, argv) == ErrorFormat::kJson;
  if (argc == 1) {
    std::cerr << app.help();
  } else if (const auto mistyped = mistyped_word(app, argc, argv)) {
    std::cerr << "regulus: " << mistyped->what() << '\n';
    if (is_json) std::cout << json_error(*mistyped, kUsageError) << std::endl;
  } else {
    const UsageError mistake = with_remedy(error, app, argv[0], argv[1]);
    std::cerr << "regulus: " << mistake.what() << '\n';
    if (is_json) std::cout << json_error(mistake, kUsageError) << std::endl;
  }
  return kUsageError;
}

}  // namespace

CommandLine parse_command_line(int argc, const char* const* argv,
                               const std::string& shell_commands) {
  CommandTables tables(shell_commands);
  const std::string_view program(argc > 0 ? argv[0] : "");
  if (program.ends_with("regulus-mpi")) tables.show_ranks();
  CommandLine result;
  try {
    tables.app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    result.exit_code = report_parse_error(tables.app, error, argc, argv);
    return result;
  }
  if (tables.check_command->parsed()) result.check = tables.check;
  if (tables.locate_command->parsed()) result.locate = tables.locate;
  if (tables.margin_command->parsed()) result.margin = tables.margin;
  if (tables.bound_command->parsed()) result.bound = tables.bound;
  if (tables.datasheet_command->parsed()) result.datasheet = tables.datasheet;
  if (tables.solve_command->parsed()) result.solve = tables.solve;
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

}  // namespace regulus::detail
