// SPDX-License-Identifier: GPL-3.0-or-later
// Model files: TOML, untrusted.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "codegen/model/model.hpp"
#include "codegen/support/work_meter.hpp"

namespace regulus::detail {

constexpr std::size_t kLargestModelFile = std::size_t{4} << 20;

/// Reads the model in a file.
///
/// Ensures   every number in it is exact: decimals are rationals, pi and roots stay symbols. Throws
///           InputError with file and line if the text is not a model, FileError if the file cannot
///           be read.
[[nodiscard]] Model load_model(const std::filesystem::path& path);

/// Overload for text that has been read; `path` stays empty. `asked`: an expression in the names of
/// the model, for Model::asked; empty: none. Throws UsageError for a mistake in it, FormingStopped if
/// `watch` stops the reading.
[[nodiscard]] Model parse_model(std::string_view text, const std::string& name_for_errors,
                                const std::string& asked = {}, const FormingWatch* watch = nullptr);

/// Returns the bytes of a model file; for a file that is too large, a few more than
/// kLargestModelFile. Throws FileError if it cannot be read.
[[nodiscard]] std::string read_model_text(const std::filesystem::path& path);

}  // namespace regulus::detail
