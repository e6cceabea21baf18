// SPDX-License-Identifier: GPL-3.0-or-later
// `regulus generate`, and the interface of programs that generate the kernel of their own C++
// model.
#pragma once

#include <string>
#include <vector>

#include "codegen/kernel/cpp/generate.hpp"

namespace CLI {
class App;
}

namespace regulus::detail {

struct GenerateCommand {
  ModelOptions model;
  std::string folder;
  std::string name;
  std::string name_space;
  std::vector<std::string> isas = {"avx512", "avx2", "portable"};
  std::string dependencies;  ///< file; empty: none
  bool object = false;       ///< also compiles the kernel
  bool json = false;
  bool quiet = false;
  int json_indent = 2;  ///< −1: all on one line
};

/// Adds the options that change a model or its motion: --range, --tolerance, --alpha.
void add_model_changes(CLI::App& app, ModelOptions& options);

/// Adds all options of generate except the model and the motion.
void add_generate_options(CLI::App& app, GenerateCommand& command);

/// Writes the files and lists them on standard output, as JSON if requested. `typed`: the command
/// line, for their heads.
///
/// Throws    UsageError, InputError, FileError; then no file has been changed.
void generate_files(const GenerateCommand& command, const Request& request,
                    const std::string& typed);

}  // namespace regulus::detail
