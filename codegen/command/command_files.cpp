// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/command/command_files.hpp"

namespace regulus::inline command {

std::vector<std::string> input_files(const ModelOptions& model, const SearchOptions& search) {
  std::vector<std::string> files = search.filters;
  files.insert(files.end(), {model.path, model.waypoints});
  return files;
}

OutputFile checkpoint_file(const std::string& path) {
  OutputFile file{"--checkpoint", path};
  file.continues = true;
  return file;
}

}  // namespace regulus::command
