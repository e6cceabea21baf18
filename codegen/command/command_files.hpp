// SPDX-License-Identifier: GPL-3.0-or-later
// The files of a command.
#pragma once

#include <string>
#include <vector>

#include "codegen/engine/options.hpp"
#include "codegen/model/request.hpp"
#include "codegen/support/earlier_outputs.hpp"

namespace regulus::inline command {

/// Returns the files that a command reads: the model, way-points, filters.
[[nodiscard]] std::vector<std::string> input_files(const ModelOptions& model,
                                                   const SearchOptions& search);

/// Returns the file of --checkpoint; `path` empty: none.
[[nodiscard]] OutputFile checkpoint_file(const std::string& path);

}  // namespace regulus::command
