// SPDX-License-Identifier: GPL-3.0-or-later
// The command line, as values. Names that the option texts spell are those of DESIGN's command
// table.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "regulus/codegen/generate/generate_command.hpp"
#include "regulus/codegen/jit/part_store.hpp"
#include "regulus/codegen/model/request.hpp"
#include "regulus/codegen/symbolic/formulation.hpp"

namespace regulus::codegen {

/// kAuto: compiled if the cache has the kernel, otherwise interpreted, and compiled beside a search
/// that becomes long. kJit: built with LLVM from the list of operations. kClang: the C++ text,
/// compiled by Clang in this process; it takes longer and computes the same bits.
enum class Engine { kAuto, kJit, kClang, kInterpreted };

/// From so many boxes on a search is worth a compiler: what it saves on a box pays for it within
/// 65 000 to 80 000 boxes, whatever the size of the kernel (runtime/PERFORMANCE.md). It takes half
/// the time of so many interpreted boxes in one thread, so that a search which ends just after it
/// began is not waited for longer than it took.
inline constexpr std::uint64_t kBoxesBeforeCompiling = 50'000;

/// `--tolerance base,platform=0.1`
struct ToleranceOption {
  std::string groups;
  std::string value;
};

/// How the search runs.
struct SearchOptions {
  std::string method = "auto";
  std::string determinant = "both";
  std::string entries = "auto";
  std::string bisect = "impact";
  std::string uncertainty = "elements";
  Engine engine = Engine::kJit;
  std::string isa;  ///< empty: the best this CPU has
  bool use_cache = true;
  std::vector<std::string> filters;                    ///< shared objects
  std::vector<std::string> without;                    ///< see ingredients.hpp
  std::uint64_t max_boxes = 0;                         ///< 0: no bound
  unsigned threads = 0;                                ///< 0: as many as there are processors
  double time_limit = 0;                               ///< seconds, 0: no bound
  std::uint64_t symbolic_budget = kDeterminantBudget;  ///< terms of a closed form
  long precision = 1024;                               ///< most bits where doubles cannot decide
  PartStore* parts = nullptr;                          ///< of kernels compiled before
  /// Of Engine::kAuto. 0: the kernel is compiled before the search, and interpreted only where
  /// there is no compiler.
  std::uint64_t boxes_before_compiling = kBoxesBeforeCompiling;
  bool threshold = false;  ///< α may be raised above 0 once the kernel is formed
};

struct OutputOptions {
  bool json = false;
  bool quiet = false;
  int json_indent = 2;  ///< −1: all on one line
};

struct CheckpointOptions {
  std::string path;      ///< empty: none
  double interval = 10;  ///< seconds
};

struct CheckCommand {
  ModelOptions model;
  SearchOptions search;
  OutputOptions output;
  std::string certificate;  ///< file; empty: none
  CheckpointOptions checkpoint;
};

struct LocateCommand {
  ModelOptions model;
  SearchOptions search;
  OutputOptions output;
  std::string resolution;  ///< part of each range, an expression; empty: by the number of ranges
  std::string axes;        ///< "p,q"; empty: the first two that are not single values
  std::string lines;       ///< file of the JSON lines, "-" = standard output; empty: see --json
  std::vector<std::string> pictures;
  std::string certificate;        ///< file; empty: none
  bool boxes_unless_json = true;  ///< print the boxes where nothing says otherwise
};

/// One of the model's tolerances, its alpha, or `scale` is a range LO:HI.
struct MarginCommand {
  ModelOptions model;
  SearchOptions search;
  OutputOptions output;
  std::string scale;  ///< empty: not that
  std::string gap = "0.01";
  std::string certificate;  ///< files, without their endings; empty: none
};

struct VerifyCommand {
  std::string path;
  std::string model;                 ///< the model file it must be about; empty: any
  std::optional<double> time_limit;  ///< in seconds
  std::optional<std::uint64_t> max_boxes;
  OutputOptions output;
};

struct ExplainCommand {
  ModelOptions model;
  bool all_entries = false;
  std::string stage = "forms";  ///< or a part of them, or "text": the C++ of the kernel
  std::string method = "auto";  ///< whose functions are shown
  std::uint64_t symbolic_budget = kDeterminantBudget;
  OutputOptions output;
};

/// `regulus shell`
struct ShellCommand {
  std::string path;  ///< a model to begin with; empty: none
  bool json = false;
};

/// What was asked. Exactly one command is set; none when `exit_code` is (--help, --version, an
/// error).
struct CommandLine {
  std::optional<int> exit_code;
  std::optional<CheckCommand> check;
  std::optional<LocateCommand> locate;
  std::optional<MarginCommand> margin;
  std::optional<ExplainCommand> explain;
  std::optional<GenerateCommand> generate;
  std::optional<VerifyCommand> verify;
  std::optional<ShellCommand> shell;
};

/// Parses the arguments. Prints help, the version and usage errors itself.
[[nodiscard]] CommandLine parse_command_line(int argc, const char* const* argv);

/// An option of a command, or an argument, as --help shows it.
struct OptionEntry {
  std::string name;   ///< "--range"; of an argument "MODEL"
  std::string value;  ///< what follows, "p=LO:HI"; empty: a flag
  std::string description;
  std::vector<std::string> choices;  ///< every value there is; empty if that is free
  bool required = false;
};

struct CommandEntry {
  std::string name, description, footer;
  std::vector<OptionEntry> arguments, options;
};

/// Every command, from the tables that parse_command_line goes by; the program itself first, under
/// the name "".
[[nodiscard]] std::vector<CommandEntry> command_table();

}  // namespace regulus::codegen
