// SPDX-License-Identifier: GPL-3.0-or-later
// A model and one of its motions, with the changes that a command line makes to them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "codegen/model/model.hpp"
#include "codegen/program/work_meter.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::inline model {

/// The options of every command that reads a model: the motion, and changes to it.
struct ModelOptions {
  std::string path;
  std::string motion;               ///< empty: the only motion of the model
  std::vector<std::string> ranges;  ///< "p=LO:HI"
  std::vector<std::string> tolerances;
  std::string alpha;                  ///< empty: the motion's own
  std::string waypoints{};            ///< file to follow instead; empty: the motion as it is
  std::vector<std::string> tubes{};   ///< "E" or "p,q=E": control errors
  std::optional<std::string> text{};  ///< of the model, instead of the file
  std::string asked{};                ///< an expression for Model::asked; empty: none
  /// Restrict every motion to the poses within reach. It does not change Motion::where: a search
  /// must say itself that the others are not safe.
  bool separates_reach = false;
  bool beyond_limits = false;  ///< the question may leave the limits of the joints
  /// Receives each note of the request as soon as it is read; empty: nothing.
  std::function<void(const std::string&)> warn{};
};

/// A model and the motion in question, with the changes of the command line applied.
struct Request {
  Model model;
  Motion motion;
  /// What may have been meant otherwise, and limits that the question leaves.
  std::vector<std::string> notes{};
};

/// Returns the text of the model. Throws FileError.
[[nodiscard]] std::string model_text(const ModelOptions& options);

/// Throws InputError or FileError for the file, UsageError for the options, FormingStopped if `watch`
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

}  // namespace regulus::model
