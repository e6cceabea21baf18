// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace regulus::detail {

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
  /// "NAME=VALUE": the question is about one place. All pose parameters make a motion of their own if
  /// none is named; otherwise they change it, as ranges do.
  std::vector<std::string> at{};
  /// The motion may have lengths of legs or a tool in the place of a pose; such a one is meant first.
  bool takes_legs = false;
  bool beyond_limits = false;  ///< the question may leave the limits of the joints
  /// Receives each note of the request as soon as it is read; empty: nothing.
  std::function<void(const std::string&)> warn{};
};

}  // namespace regulus::detail
