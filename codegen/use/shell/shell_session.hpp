// SPDX-License-Identifier: GPL-3.0-or-later
// The state of the shell between two lines, and the execution of a line. A session makes a command
// line from its state and runs the command of that name.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "codegen/kernel/jit/cache/part_store.hpp"
#include "codegen/model/model.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "codegen/use/command/command_line.hpp"
#include "codegen/use/shell/shell_completion.hpp"

namespace regulus::detail {

class ShellSession {
 public:
  explicit ShellSession(bool json) : json_(json) {}

  /// Runs a line. Returns the exit code of its command, 0 if it has none. Throws the exceptions of
  /// commands.
  int execute(const std::string& line);

  /// Returns the commands of a session, a line for each.
  [[nodiscard]] static std::string commands();

  /// Returns the model and the motion, before the sign that asks for a line.
  [[nodiscard]] std::string prompt() const;
  /// Returns the lines at the beginning of a session: what can be tried.
  [[nodiscard]] std::string greeting() const;

  [[nodiscard]] bool ended() const noexcept { return ended_; }
  [[nodiscard]] bool keeps_going() const noexcept { return keep_going_; }
  [[nodiscard]] ShellNames names() const;

 private:
  using Words = std::vector<std::string>;
  /// An option that has been set; `key` distinguishes options that may be repeated.
  struct Setting {
    std::string option, key, value;
    bool operator==(const Setting&) const = default;
  };
  /// The subject of a question.
  struct Asked {
    std::string path;
    std::string text;  ///< of the model, with its changes
    Words edits;       ///< by commands: "entry (1,1)", "let e1_y", "text"
    std::optional<Model> model;
    std::string motion;
    std::vector<Setting> settings;
    bool operator==(const Asked& other) const;
  };

  int load(const Words& words);
  int motions(const Words& words);
  int motion(const Words& words);
  struct Entry;

  int show(const Words& words);
  int show_settings(const std::string& before = "");
  int show_everything();
  [[nodiscard]] static std::string help_about(const Entry& entry);
  int set(const Words& words);
  int unset(const Words& words);
  int reload(const Words& words);
  int edit(const Words& words);
  int change_expression(const Words& words);
  int plot(const Words& words);
  int save(const Words& words);
  int history(const Words& words);
  int help(const Words& words);
  int undo(const Words& words);
  int quit(const Words& words);
  int run(const Words& words);
  int run_line(const Words& words);

  /// Returns the command line of these words, of the settings, and of the model.
  [[nodiscard]] static Words whole_line(const Asked& asked, const Words& words);
  [[nodiscard]] static CommandLine parsed(const Asked& asked, const Words& words);
  void adopt(CommandLine& line);
  void change(const Setting& setting, bool keep);
  static void require_valid(const Asked& asked);
  void require_model() const;
  void take(std::string text, const Words& edits);
  [[nodiscard]] Words edits_and(const std::string& edit) const;
  int prepare_again();
  void say(const std::string& text, const std::string& json) const;

  bool json_;
  bool ended_ = false;
  bool keep_going_ = false;
  Asked asked_;
  std::string draft_;  ///< an edited text with a mistake; else empty
  PartStore parts_;    ///< of the kernels of this session
  Words history_;
  struct Change {
    Asked before;
    std::string line;  ///< that made it
  };
  class KeptForUndo;
  std::vector<Change> changes_;  ///< what undo takes back, the last one at the end

  static const std::vector<Entry>& table();
};

}  // namespace regulus::detail
