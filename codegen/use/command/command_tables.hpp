// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "codegen/use/command/command_line.hpp"

namespace regulus::detail {

/// The tables of all commands, and the values that they fill.
struct CommandTables {
  CLI::App app;
  CheckCommand check;
  LocateCommand locate;
  MarginCommand margin;
  BoundCommand bound;
  DatasheetCommand datasheet;
  SolveCommand solve;
  ReportCommand report;
  ExplainCommand explain;
  GenerateCommand generate;
  VerifyCommand verify;
  ImportCommand import;
  ListCommand list;
  ShellCommand shell;
  CLI::App* check_command;
  CLI::App* locate_command;
  CLI::App* margin_command;
  CLI::App* bound_command;
  CLI::App* datasheet_command;
  CLI::App* solve_command;
  CLI::App* report_command;
  CLI::App* explain_command;
  CLI::App* generate_command;
  CLI::App* verify_command;
  CLI::App* import_command;
  CLI::App* list_command;
  CLI::App* shell_command;

  /// `shell_commands`: the first part of the footer of `shell`.
  explicit CommandTables(const std::string& shell_commands);
  /// Makes the help that of regulus-mpi, which runs some of the commands.
  void show_ranks();

 private:
  void add_check();
  void add_locate();
  void add_margin();
  void add_bound();
  void add_datasheet();
  void add_solve();
  void add_report();
};

}  // namespace regulus::detail
