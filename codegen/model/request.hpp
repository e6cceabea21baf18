// SPDX-License-Identifier: GPL-3.0-or-later
// A model and one of its motions, with the changes that a command line makes to them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "codegen/model/model.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::inline model {

/// What every command that reads a model takes: which variety, with which changes.
struct ModelOptions {
  std::string path;
  std::string motion;               ///< empty: the model's only one
  std::vector<std::string> ranges;  ///< "p=LO:HI"
  std::vector<std::string> tolerances;
  std::string alpha;                  ///< empty: the motion's own
  std::optional<std::string> text{};  ///< of the model, in place of what the file holds
};

/// A model and the one motion to look at, with the command line's changes made.
struct Request {
  Model model;
  Motion motion;
};

/// The text of the model. Throws FileError.
[[nodiscard]] std::string model_text(const ModelOptions& options);

/// Throws InputError or FileError for the file, UsageError for the options.
[[nodiscard]] Request read_request(const ModelOptions& options);
/// The same where the bytes of the file have been read.
[[nodiscard]] Request read_request(std::string_view text, const ModelOptions& options);

struct Assignment {
  std::string name, value;
};
/// "GROUP=VALUE" in two. Throws UsageError naming the option.
[[nodiscard]] Assignment split_assignment(const std::string& text, const char* option);

/// Runs an override; its complaints are about the command line, not about the model file.
template <class Change>
void from_option(const char* option, Change change) {
  try {
    change();
  } catch (const InputError& error) {
    throw UsageError(std::string(option) + ": " + error.what());
  }
}

}  // namespace regulus::inline model
