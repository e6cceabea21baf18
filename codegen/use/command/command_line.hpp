// SPDX-License-Identifier: GPL-3.0-or-later
// The command line, as values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "codegen/answer/picture/picture_options.hpp"
#include "codegen/answer/report/output_options.hpp"
#include "codegen/question/engine/options.hpp"
#include "codegen/question/margin/margin_question.hpp"
#include "codegen/use/command/bound_options.hpp"
#include "codegen/use/command/generate_options.hpp"
#include "codegen/use/command/import_options.hpp"
#include "codegen/use/command/list_options.hpp"
#include "codegen/use/command/report_options.hpp"

namespace regulus::detail {

struct CheckCommand {
  ModelOptions model;
  SearchOptions search;
  OutputOptions output;
  std::optional<std::string> load{};  ///< the question is about forces that hold it
  std::string certificate;            ///< file; empty: none
  std::uint64_t shard_size = 0;       ///< of its shards, in bytes; 0: it is one file
  CheckpointOptions checkpoint;
};

struct LocateCommand {
  ModelOptions model;
  SearchOptions search;
  OutputOptions output;
  std::optional<std::string> load{};  ///< as of check
  std::string resolution;  ///< part of each range, an expression; empty: by the number of ranges
  std::string lines;       ///< file of the JSON lines, "-" = standard output; empty: none
  PictureRequest pictures;
  std::string certificate;       ///< file; empty: none
  std::uint64_t shard_size = 0;  ///< of its shards, in bytes; 0: it is one file
  CheckpointOptions checkpoint;
};

/// One of the model's tolerances, its alpha, or `size` has a range LO:HI.
struct MarginCommand {
  ModelOptions model;
  QuantityOptions quantity;  ///< that must keep the limit; empty: no singularity
  SearchOptions search;
  OutputOptions output;
  GrowingSize size;
  std::string limit;  ///< empty without a quantity
  std::string gap = "0.01";
  std::string certificate;       ///< files, without their endings; empty: none
  std::uint64_t shard_size = 0;  ///< of their shards, in bytes; 0: each is one file
  std::string checkpoint;        ///< file; empty: none
};

/// `regulus solve`
struct SolveCommand {
  ModelOptions model;
  SearchOptions search;
  std::vector<std::string> held;
  OutputOptions output;
  std::string table{};           ///< file of places, as of way-points; empty: there is one place
  std::string lines{};           ///< file of the JSON lines of many places, "-" = standard output
  std::string certificate{};     ///< file; empty: none
  std::uint64_t shard_size = 0;  ///< of its shards, in bytes, of many places; 0: it is one file
  CheckpointOptions checkpoint;
};

struct VerifyCommand {
  std::string path;
  std::string model;                 ///< the model file it must be about; empty: any
  std::string waypoints;             ///< the file of way-points that check took; empty: none
  bool allows_options = false;       ///< options may have changed what the model file says
  std::optional<double> time_limit;  ///< in seconds
  std::optional<std::uint64_t> max_boxes;
  unsigned threads = 1;
  OutputOptions output;
};

struct ExplainCommand {
  ModelOptions model;
  bool all_entries = false;
  std::string stage = "forms";    ///< or a part of them, or "text": the C++ of the kernel
  Method method = Method::kAuto;  ///< whose functions are shown
  std::uint64_t symbolic_budget = kDeterminantBudget;
  OutputOptions output;
};

/// `regulus shell`
struct ShellCommand {
  std::string path;  ///< a model to begin with; empty: none
  bool json = false;
};

/// The parsed command line. Exactly one command is set; none if `exit_code` is set (--help,
/// --version, an error).
struct CommandLine {
  std::optional<int> exit_code;
  std::optional<CheckCommand> check;
  std::optional<LocateCommand> locate;
  std::optional<MarginCommand> margin;
  std::optional<BoundCommand> bound;
  std::optional<DatasheetCommand> datasheet;
  std::optional<SolveCommand> solve;
  std::optional<ReportCommand> report;
  std::optional<ExplainCommand> explain;
  std::optional<GenerateCommand> generate;
  std::optional<VerifyCommand> verify;
  std::optional<ImportCommand> import;
  std::optional<ListCommand> list;
  std::optional<ShellCommand> shell;
};

/// Parses the arguments. Prints help, the version and usage errors itself; `shell_commands` goes
/// into the help of `regulus shell`.
[[nodiscard]] CommandLine parse_command_line(int argc, const char* const* argv,
                                             const std::string& shell_commands = {});

/// An option of a command, or an argument, as --help shows it.
struct OptionEntry {
  std::string name;   ///< "--range"; of an argument "MODEL"
  std::string value;  ///< its value, "p=LO:HI"; empty: a flag
  std::string description;
  std::vector<std::string> choices;  ///< all values; empty if any text is allowed
  bool required = false;
  std::string group;  ///< one of option_groups(); of an argument empty
};

struct CommandEntry {
  std::string name, description, footer, examples;
  std::vector<OptionEntry> arguments, options;
};

/// Returns the text of `regulus COMMAND --help`; empty for a word that is no command.
[[nodiscard]] std::string help_of(const std::string& command);

/// Returns every command, from the tables of parse_command_line; the program itself first, with the
/// name "". `shell_commands` is the first part of the footer of `shell`.
[[nodiscard]] std::vector<CommandEntry> command_table(const std::string& shell_commands = {});

}  // namespace regulus::detail
