// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace regulus::detail {

/// `regulus list`
struct ListCommand {
  std::string path;  ///< a model whose motions are listed; empty: the installed models
  bool json = false;
  bool quiet = false;  ///< only the names
};

void add_list_options(CLI::App& app, ListCommand& command);

}  // namespace regulus::detail
