// SPDX-License-Identifier: GPL-3.0-or-later
// The options of `regulus import`.
#pragma once

#include <string>

#include "codegen/model/import/import.hpp"

namespace CLI {
class App;
}

namespace regulus::detail {

struct ImportCommand {
  std::string path;
  std::string output;  ///< file; empty: standard output
  ImportOptions options;
  bool quiet = false;
  bool json = false;
};

void add_import_options(CLI::App& app, ImportCommand& command);

}  // namespace regulus::detail
