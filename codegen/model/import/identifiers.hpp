// SPDX-License-Identifier: GPL-3.0-or-later
// Names of a file as names of a model.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace regulus::detail {

/// Makes names that a model file may use, no two of them equal.
class Identifiers {
 public:
  /// Returns the name itself if possible, else one with letters, digits and underscores.
  [[nodiscard]] std::string of(const std::string& name);

  /// Each name that changed: "'elbow-joint' is elbow_joint".
  [[nodiscard]] const std::vector<std::string>& changes() const noexcept { return changes_; }

 private:
  std::set<std::string> used_;
  std::vector<std::string> changes_;
};

}  // namespace regulus::detail
