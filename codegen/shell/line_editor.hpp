// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace regulus::inline shell {

/// Lines that a person types: edited, completed with Tab, remembered from session to session. Where
/// libedit was not there when the program was built, as they come from the terminal.
class LineEditor {
 public:
  /// What the last word of the text before the cursor can become.
  using Complete = std::function<std::vector<std::string>(const std::string& before)>;

  /// `history`: a file; empty, or one that cannot be written: none is kept.
  LineEditor(const std::string& prompt, std::filesystem::path history, Complete complete);
  ~LineEditor();
  LineEditor(const LineEditor&) = delete;
  LineEditor& operator=(const LineEditor&) = delete;

  /// The next line without its end. nullopt at the end of the input; empty after an interrupt.
  [[nodiscard]] std::optional<std::string> next();

 private:
  struct Library;
  std::unique_ptr<Library> library_;
};

/// XDG_STATE_HOME/regulus/history, ~/.local/state otherwise; empty without a home.
[[nodiscard]] std::filesystem::path history_file();

}  // namespace regulus::inline shell
