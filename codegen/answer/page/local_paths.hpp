// SPDX-License-Identifier: GPL-3.0-or-later
// The paths of one computer, which a page for others does not show.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "codegen/model/model_options.hpp"

namespace regulus::detail {

class LocalPaths {
 public:
  /// Takes the files of a model, and those that options of a command line name.
  LocalPaths(const ModelOptions& model, std::string_view typed);

  /// Takes one more file; a name without a folder needs none.
  void add(std::string_view path);

  /// Replaces each path in a text by the name of its file.
  void remove_from(std::string& text) const;
  /// The same in all strings of a report.
  void remove_from(nlohmann::ordered_json& report) const;

 private:
  std::vector<std::string> paths_;  ///< with a folder, the longest first
};

}  // namespace regulus::detail
