// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace regulus::detail {

/// Reads typed lines, with editing, completion by Tab, and a history over sessions. If the program
/// was built without libedit, it reads plain lines from the terminal.
class LineEditor {
 public:
  /// Returns the completions of the last word before the cursor.
  using Complete = std::function<std::vector<std::string>(const std::string& before)>;

  /// `history`: a file; if it is empty or cannot be written, no history is kept.
  LineEditor(std::filesystem::path history, Complete complete);
  ~LineEditor();
  LineEditor(const LineEditor&) = delete;
  LineEditor& operator=(const LineEditor&) = delete;

  /// Returns the next line without its end. nullopt at the end of the input; empty after an
  /// interrupt.
  [[nodiscard]] std::optional<std::string> next(const std::string& prompt);

 private:
  struct Library;
  std::unique_ptr<Library> library_;
};

/// Returns XDG_STATE_HOME/regulus/history, or the same below ~/.local/state; empty without a home.
[[nodiscard]] std::filesystem::path history_file();

}  // namespace regulus::detail
