// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of a model file, and the text of the file made from them.
#pragma once

#include <string>
#include <vector>

namespace regulus::detail::test {

/// A model and the facts known about it beforehand.
struct ModelText {
  std::string kind;                              ///< for messages and tallies
  std::string geometry, let, motion;             ///< lines of these sections
  std::vector<std::vector<std::string>> matrix;  ///< rows of expressions
  std::vector<std::string> row_scale;
  bool never_safe = false;      ///< NO SINGULARITY would be wrong
  bool never_singular = false;  ///< SINGULARITY would be wrong

  [[nodiscard]] std::string file() const {
    std::string rows;
    for (const auto& row : matrix) rows += "  " + list(row) + ",\n";
    return "regulus = 1\nname = \"" + kind +
           "\"\n\n[pose]\nx = \"1\"\ny = \"1\"\nphi = \"rad\"\n\n[geometry]\n" + geometry +
           "\n[let]\n" + let + "\n[matrix]\nrows = [\n" + rows + "]\n" +
           (row_scale.empty() ? "" : "row_scale = " + list(row_scale) + "\n") +
           "\n[motion.only]\n" + motion;
  }

 private:
  static std::string list(const std::vector<std::string>& items) {
    std::string text;
    for (const std::string& item : items) text += (text.empty() ? "\"" : ", \"") + item + '"';
    return '[' + text + ']';
  }
};

}  // namespace regulus::detail::test
