// SPDX-License-Identifier: GPL-3.0-or-later
// The changes of a session's model, and how they are taken back.
#include <fmt/format.h>

#include <charconv>
#include <iostream>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/report_text.hpp"
#include "codegen/model/file/model_edit.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/model/names.hpp"
#include "codegen/use/shell/kept_options.hpp"
#include "codegen/use/shell/shell_session.hpp"
#include "codegen/use/shell/shell_words.hpp"
#include "codegen/use/shell/text_editor.hpp"

namespace regulus::detail {
namespace {

int position(const std::string& word) {
  int value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size())
    reject(in_quotes(word) + " is no number of a row or a column", "they count from 1");
  return value;
}

}  // namespace

bool ShellSession::Asked::operator==(const Asked& other) const {
  return path == other.path && text == other.text && edits == other.edits &&
         motion == other.motion && settings == other.settings;
}

int ShellSession::undo(const Words& words) {
  if (words.size() != 1) refuse(rest_of(words, 0), "undo");
  if (changes_.empty())
    reject("nothing is left to undo", "undo takes back load, motion, set, unset, edit and reload");
  const std::string line = changes_.back().line;
  asked_ = std::move(changes_.back().before);
  changes_.pop_back();
  draft_.clear();
  say("taken back: " + line, report_text({{"undone", line}}));
  return 0;
}

/// Refuses a text that is not a model, or that does not fit the settings; the session keeps the
/// earlier model.
void ShellSession::take(std::string text, const Words& edits) {
  Asked changed = asked_;
  changed.edits = edits;
  changed.model = parse_model(text, asked_.path);
  changed.text = std::move(text);
  require_valid(changed);
  asked_ = std::move(changed);
  draft_.clear();
}

/// An edit that is made again is named once.
ShellSession::Words ShellSession::edits_and(const std::string& edit) const {
  Words edits = asked_.edits;
  std::erase(edits, edit);
  edits.push_back(edit);
  return edits;
}

int ShellSession::change_expression(const Words& words) {
  require_model();
  if (words[1] == "entry") {
    if (words.size() < 5) refuse(rest_of(words, 0), "set entry ROW COLUMN EXPRESSION");
    const bool has_legs = is_gough(asked_.text);
    const std::string text = has_legs ? with_matrix_of_gough(asked_.text) : asked_.text;
    take(with_entry(text, position(words[2]), position(words[3]), rest_of(words, 4)),
         edits_and(fmt::format("entry ({},{})", words[2], words[3])));
    if (has_legs)
      std::cerr << "note       the six legs of [gough] are now rows of [matrix], without the units "
                   "of their lengths\n";
  } else {
    if (words.size() < 4) refuse(rest_of(words, 0), "set let NAME EXPRESSION");
    take(with_let(asked_.text, words[2], rest_of(words, 3)), edits_and("let " + words[2]));
  }
  return asked_.motion.empty() ? 0 : prepare_again();
}

/// The next edit begins with a text that had a mistake.
int ShellSession::edit(const Words& words) {
  require_model();
  if (words.size() != 1) refuse(rest_of(words, 0), "edit");
  draft_ = edited(draft_.empty() ? asked_.text : draft_);
  if (draft_ == asked_.text) return draft_.clear(), 0;
  take(draft_, edits_and("text"));
  return asked_.motion.empty() ? 0 : prepare_again();
}

int ShellSession::reload(const Words& words) {
  require_model();
  if (words.size() != 1) refuse(rest_of(words, 0), "reload");
  take(read_model_text(asked_.path), {});
  return asked_.motion.empty() ? 0 : prepare_again();
}

}  // namespace regulus::detail
