// SPDX-License-Identifier: GPL-3.0-or-later
// A model and one of its motions, with the changes that a command line makes to them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "codegen/model/model.hpp"
#include "codegen/model/model_options.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/work_meter.hpp"

namespace regulus::detail {

/// A model and the motion in question, with the changes of the command line applied.
struct Request {
  Model model;
  Motion motion;
  /// What may have been meant otherwise, and limits that the question leaves.
  std::vector<std::string> notes{};
};

/// Returns the text of the model. Throws FileError.
[[nodiscard]] std::string model_text(const ModelOptions& options);

/// Throws InputError or FileError for the file, UsageError for the options, ReadingStopped if `watch`
/// stops the reading.
[[nodiscard]] Request read_request(const ModelOptions& options,
                                   const FormingWatch* watch = nullptr);
/// Overload for a file that has been read.
[[nodiscard]] Request read_request(std::string_view text, const ModelOptions& options,
                                   const FormingWatch* watch = nullptr);

struct Assignment {
  std::string name, value;
};
/// Splits "GROUP=VALUE" in two. Throws UsageError that names the option.
[[nodiscard]] Assignment split_assignment(const std::string& text, const char* option);

/// Runs an override. Its errors are reported as UsageError, because the mistake is in the command
/// line.
template <class Change>
void from_option(const char* option, Change change) {
  try {
    change();
  } catch (const InputError& error) {
    throw UsageError(std::string(option) + ": " + error.what());
  }
}

}  // namespace regulus::detail
