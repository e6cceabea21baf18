// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/shell_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "regulus/codegen/driver/exit_code.hpp"
#include "regulus/codegen/driver/report_parts.hpp"
#include "regulus/codegen/driver/run_command_line.hpp"
#include "regulus/codegen/driver/shell_words.hpp"
#include "regulus/codegen/driver/text_editor.hpp"
#include "regulus/codegen/model/model_edit.hpp"
#include "regulus/codegen/model/model_file.hpp"
#include "regulus/codegen/model/names.hpp"
#include "regulus/codegen/model/overrides.hpp"
#include "regulus/codegen/model/request.hpp"

namespace regulus::codegen {
namespace {

using Json = nlohmann::ordered_json;

/// Has been said already.
struct CommandLineRefused {
  int code;
};

[[noreturn]] void refuse(const std::string& found, const std::string& expected) {
  throw UsageError("found " + found + ", expected " + expected);
}

int position(const std::string& word) {
  int value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size())
    refuse("'" + word + "'", "a number of a row or column, from 1");
  return value;
}

bool switched_on(const std::vector<std::string>& words) {
  if (words.size() == 3 && words[2] == "on") return true;
  if (words.size() == 3 && words[2] == "off") return false;
  refuse(rest_of(words, 0), "set " + words[1] + " on|off");
}

std::vector<std::string> motion_names(const Model& model) {
  std::vector<std::string> names;
  for (const Motion& motion : model.motions) names.push_back(motion.name);
  return names;
}

std::string listed(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, " "));
}

const CommandEntry& entry_of_check() {
  static const std::vector<CommandEntry> kTable = command_table();
  return *std::ranges::find(kTable, "check", &CommandEntry::name);
}

const OptionEntry* option_of_check(const std::string& name) {
  const auto& options = entry_of_check().options;
  const auto at = std::ranges::find(options, "--" + name, &OptionEntry::name);
  return at == options.end() ? nullptr : &*at;
}

/// What a session keeps by itself, or a command is to be told each time.
bool may_be_kept(const std::string& option) {
  static const std::vector<std::string> kNot = {"json",        "quiet",      "help",
                                                "certificate", "checkpoint", "checkpoint-every"};
  return std::ranges::find(kNot, option) == kNot.end();
}

std::vector<std::string> names_of_options() {
  std::vector<std::string> names;
  for (const OptionEntry& option : entry_of_check().options)
    if (option.name.starts_with("--") && may_be_kept(option.name.substr(2)))
      names.push_back(option.name.substr(2));
  return names;
}

bool takes_names(const std::string& option) { return option == "range" || option == "tolerance"; }

}  // namespace

struct ShellSession::Entry {
  const char* name;
  const char* usage;
  const char* summary;
  int (ShellSession::*run)(const Words&);
};

const std::vector<ShellSession::Entry>& ShellSession::table() {
  using S = ShellSession;
  static const std::vector<Entry> kTable = {
      {"load", "load MODEL", "read a model file; what was set is forgotten", &S::load},
      {"motions", "motions", "list the motions of the model", &S::motions},
      {"motion", "motion NAME", "choose a motion", &S::motion},
      {"show", "show matrix|forms|occurrences|text|settings",
       "show what explain shows, or what is set", &S::show},
      {"set", "set OPTION [VALUE]",
       "set an option of check: range p=LO:HI, tolerance G=E, alpha A, method M …;\n"
       "set entry I J EXPR, set let NAME EXPR: change the matrix or a sub-expression;\n"
       "set keep-going on|off, set json on|off",
       &S::set},
      {"edit", "edit", "change the model's text in the editor that EDITOR names", &S::edit},
      {"reload", "reload", "read the model file again; what was set stays", &S::reload},
      {"unset", "unset OPTION [NAME]", "back to what the model or the default says", &S::unset},
      {"check", "check [OPTIONS]", "prove that there is no singular pose, or show one", &S::run},
      {"locate", "locate [OPTIONS]", "pave the motion: free, singular, undecided", &S::run},
      {"margin", "margin OPTIONS", "bracket what is safe, e.g. margin --tolerance base=0:1",
       &S::run},
      {"plot", "plot FILE.svg|FILE.png [OPTIONS]", "locate, drawn", &S::plot},
      {"verify", "verify FILE", "check a certificate, which check --certificate FILE writes",
       &S::run},
      {"history", "history", "list the lines of this session", &S::history},
      {"help", "help [COMMAND]", "list the commands, or say more about one", &S::help},
      {"save", "save FILE", "write the model with the changes made to its expressions", &S::save},
      {"quit", "quit", "end the session", &S::quit},
  };
  return kTable;
}

int ShellSession::execute(const std::string& line) {
  const Words words = split_words(line);
  if (words.empty()) return 0;
  history_.push_back(line);
  std::vector<std::string> known;
  for (const Entry& entry : table()) {
    if (words[0] == entry.name) try {
        return (this->*entry.run)(words);
      } catch (const CommandLineRefused& refused) {
        return refused.code;
      }
    known.emplace_back(entry.name);
  }
  const std::string meant = nearest(words[0], known);
  refuse("the command " + in_quotes(words[0]),
         meant.empty() ? "one that help lists" : in_quotes(meant));
}

void ShellSession::say(const std::string& text, const std::string& json) const {
  std::cout << (json_ ? json : text) << '\n' << std::flush;
}

void ShellSession::require_model() const {
  if (!asked_.model) refuse("no model", "load MODEL first");
}

// ---- the model ----

int ShellSession::load(const Words& words) {
  if (words.size() != 2) refuse(rest_of(words, 0), "load MODEL");
  std::string text = read_model_text(words[1]);
  Model model = parse_model(text, words[1]);
  asked_.path = words[1];
  asked_.text = std::move(text);
  draft_.clear();
  asked_.model = std::move(model);
  asked_.motion = asked_.model->motions.size() == 1 ? asked_.model->motions.front().name : "";
  asked_.settings.clear();
  const auto names = motion_names(*asked_.model);
  say(fmt::format("{}: {}×{}, motions {}", asked_.model->name, asked_.model->matrix.rows(),
                  asked_.model->matrix.cols(), listed(names)),
      Json{{"model", asked_.model->name}, {"path", asked_.path}, {"motions", names}}.dump());
  return 0;
}

int ShellSession::motions(const Words&) {
  require_model();
  const auto names = motion_names(*asked_.model);
  say(fmt::format("{}", fmt::join(names, "\n")), Json{{"motions", names}}.dump());
  return 0;
}

int ShellSession::motion(const Words& words) {
  require_model();
  if (words.size() != 2) refuse(rest_of(words, 0), "motion NAME");
  from_option("motion", [&] { static_cast<void>(find_motion(*asked_.model, words[1])); });
  asked_.motion = words[1];
  // A range is of a motion's parameters.
  std::erase_if(asked_.settings, [](const Setting& s) { return s.option == "range"; });
  return 0;
}

int ShellSession::save(const Words& words) {
  require_model();
  if (words.size() != 2) refuse(rest_of(words, 0), "save FILE");
  std::ofstream file(words[1], std::ios::binary);
  file << asked_.text;
  if (!file.flush()) throw FileError("cannot write " + words[1]);
  return 0;
}

/// What is no model, or not one for what is set, is refused, and the session keeps what it had.
void ShellSession::take(std::string text) {
  Asked changed = asked_;
  changed.model = parse_model(text, asked_.path);
  changed.text = std::move(text);
  require_valid(changed);
  asked_ = std::move(changed);
  draft_.clear();
}

int ShellSession::change_expression(const Words& words) {
  require_model();
  if (words[1] == "entry") {
    if (words.size() < 5) refuse(rest_of(words, 0), "set entry ROW COLUMN EXPRESSION");
    take(with_entry(asked_.text, position(words[2]), position(words[3]), rest_of(words, 4)));
  } else {
    if (words.size() < 4) refuse(rest_of(words, 0), "set let NAME EXPRESSION");
    take(with_let(asked_.text, words[2], rest_of(words, 3)));
  }
  return asked_.motion.empty() ? 0 : prepare_again();
}

/// A text with a mistake is what the next edit begins with.
int ShellSession::edit(const Words& words) {
  require_model();
  if (words.size() != 1) refuse(rest_of(words, 0), "edit");
  draft_ = edited(draft_.empty() ? asked_.text : draft_);
  if (draft_ == asked_.text) return draft_.clear(), 0;
  take(draft_);
  return asked_.motion.empty() ? 0 : prepare_again();
}

int ShellSession::reload(const Words& words) {
  require_model();
  if (words.size() != 1) refuse(rest_of(words, 0), "reload");
  take(read_model_text(asked_.path));
  return asked_.motion.empty() ? 0 : prepare_again();
}

/// Every stage goes by its own input: where an edit leaves the text of the kernel as it was (after
/// a change to a name), the cache has the whole of it, and otherwise the functions it leaves are
/// known.
int ShellSession::prepare_again() {
  CommandLine line = parsed(asked_, {"check"});
  adopt(line);
  const Preparation p = prepare(line.check->model, line.check->search);
  const StageSeconds spent = p.seconds_spent();
  const std::size_t functions = p.parts.compiled + p.parts.known;
  const std::string kernel =
      p.cache == "hit" ? "unchanged or known"
      : functions == 0 ? "interpreted"
                       : fmt::format("{} of {} functions compiled", p.parts.compiled, functions);
  say(time_line(spent) + "kernel     " + kernel, Json{{"seconds", json_seconds(spent)},
                                                      {"cache", p.cache},
                                                      {"functions", functions},
                                                      {"compiled", p.parts.compiled}}
                                                     .dump());
  return 0;
}

// ---- settings ----

void ShellSession::require_valid(const Asked& asked) {
  CommandLine line = parsed(asked, {"check"});
  if (!asked.model || asked.motion.empty()) return;
  line.check->model.text = asked.text;
  static_cast<void>(read_request(line.check->model));
}

void ShellSession::change(const Setting& setting, bool keep) {
  Asked changed = asked_;
  std::erase_if(changed.settings, [&](const Setting& s) {
    return s.option == setting.option && (setting.key.empty() || s.key == setting.key);
  });
  if (keep) changed.settings.push_back(setting);
  require_valid(changed);
  asked_ = std::move(changed);
}

int ShellSession::set(const Words& words) {
  if (words.size() < 2) refuse("set", "set OPTION [VALUE]");
  const std::string& what = words[1];
  if (what == "entry" || what == "let") return change_expression(words);
  if (what == "keep-going") return keep_going_ = switched_on(words), 0;
  if (what == "json") return json_ = switched_on(words), 0;
  const OptionEntry* option = option_of_check(what);
  if (option == nullptr || !may_be_kept(what)) {
    const std::string meant = nearest(what, names_of_options());
    refuse("the option " + in_quotes(what),
           meant.empty() ? "an option of check (see: help set)" : in_quotes(meant));
  }
  const std::string value = rest_of(words, 2);
  if (option->value.empty() != value.empty())
    refuse(rest_of(words, 0), "set " + what + (option->value.empty() ? "" : " " + option->value));
  const std::string key = takes_names(what)                       ? value.substr(0, value.find('='))
                          : what == "without" || what == "filter" ? value
                                                                  : "";
  change({what, key, value}, true);
  return 0;
}

int ShellSession::unset(const Words& words) {
  if (words.size() != 2 && words.size() != 3) refuse(rest_of(words, 0), "unset OPTION [NAME]");
  const auto is_meant = [&](const Setting& s) {
    return s.option == words[1] && (words.size() == 2 || s.key == words[2]);
  };
  if (std::ranges::none_of(asked_.settings, is_meant))
    refuse(rest_of(words, 1), "what has been set");
  change({words[1], words.size() == 3 ? words[2] : "", ""}, false);
  return 0;
}

int ShellSession::show_settings() {
  Json json{{"model", asked_.path}, {"motion", asked_.motion}, {"settings", Json::array()}};
  std::string text = fmt::format("model {}\nmotion {}", asked_.path.empty() ? "none" : asked_.path,
                                 asked_.motion.empty() ? "none" : asked_.motion);
  for (const Setting& s : asked_.settings) {
    text += fmt::format("\n{}{}{}", s.option, s.value.empty() ? "" : " ", s.value);
    json["settings"].push_back({{"option", s.option}, {"value", s.value}});
  }
  say(text, json.dump());
  return 0;
}

// ---- commands ----

/// The command line of these words, of what is set, and of the model; what a command does not know
/// is left out.
CommandLine ShellSession::parsed(const Asked& asked, const Words& words) {
  static const std::vector<CommandEntry> kTable = command_table();
  const auto& options = std::ranges::find(kTable, words[0], &CommandEntry::name)->options;
  Words line = {"regulus", words[0]};
  if (words[0] != "verify") {
    line.push_back(asked.path.empty() ? "MODEL" : asked.path);
    if (!asked.motion.empty()) line.push_back(asked.motion);
    for (const Setting& s : asked.settings) {
      const std::string option = "--" + s.option;
      if (std::ranges::find(options, option, &OptionEntry::name) == options.end()) continue;
      const bool typed = !takes_names(s.option) && std::ranges::find(words, option) != words.end();
      if (typed) continue;
      line.push_back(option);
      if (!s.value.empty()) line.back() += "=" + s.value;
    }
  }
  line.insert(line.end(), words.begin() + 1, words.end());
  std::vector<const char*> arguments;
  for (const std::string& word : line) arguments.push_back(word.c_str());
  CommandLine result = parse_command_line(static_cast<int>(arguments.size()), arguments.data());
  if (result.exit_code) throw CommandLineRefused{*result.exit_code};
  return result;
}

/// The model is the one in memory. Its kernel is compiled before the search: what it has in common
/// with earlier ones is compiled already, and the process keeps it.
void ShellSession::adopt(CommandLine& line) {
  const auto with = [&](ModelOptions& model, OutputOptions& output) {
    model.text = asked_.text;
    output.json = output.json || json_;
    output.json_indent = json_ ? -1 : output.json_indent;
  };
  const auto wait = [this](SearchOptions& search) {
    search.boxes_before_compiling = 0;
    search.parts = &parts_;
  };
  if (line.check) with(line.check->model, line.check->output), wait(line.check->search);
  if (line.locate) with(line.locate->model, line.locate->output), wait(line.locate->search);
  if (line.locate) line.locate->boxes_unless_json = false;
  if (line.margin) with(line.margin->model, line.margin->output), wait(line.margin->search);
  if (line.explain) with(line.explain->model, line.explain->output);
  if (line.generate) {
    line.generate->model.text = asked_.text;
    line.generate->json = line.generate->json || json_;
    line.generate->json_indent = json_ ? -1 : line.generate->json_indent;
  }
  if (!line.verify) return;
  line.verify->output.json = line.verify->output.json || json_;
  line.verify->output.json_indent = json_ ? -1 : line.verify->output.json_indent;
}

int ShellSession::run(const Words& words) {
  if (words[0] != "verify") require_model();
  CommandLine line = parsed(asked_, words);
  adopt(line);
  return run_command_line(line, rest_of(words, 0));
}

int ShellSession::plot(const Words& words) {
  if (words.size() < 2) refuse("plot", "plot FILE.svg|FILE.png");
  Words located = {"locate", "--picture", words[1]};
  located.insert(located.end(), words.begin() + 2, words.end());
  return run(located);
}

int ShellSession::show(const Words& words) {
  if (words.size() == 2 && words[1] == "settings") return show_settings();
  require_model();
  static const Words kParts = {"matrix", "forms", "occurrences", "text"};
  if (words.size() != 2 || std::ranges::find(kParts, words[1]) == kParts.end())
    refuse(rest_of(words, 0), "show matrix|forms|occurrences|text|settings");
  if (words[1] == "text" && asked_.motion.empty()) refuse("no motion", "motion NAME first");
  CommandLine line = parsed(asked_, {"explain", "--stage", words[1]});
  adopt(line);
  return run_command_line(line, rest_of(words, 0));
}

int ShellSession::history(const Words&) {
  say(fmt::format("{}", fmt::join(history_, "\n")), Json{{"history", history_}}.dump());
  return 0;
}

std::string ShellSession::commands() {
  std::string text;
  for (const Entry& entry : table()) {
    const std::string summary = entry.summary;
    text += fmt::format("{:<44}{}\n", entry.usage, summary.substr(0, summary.find('\n')));
  }
  return text;
}

int ShellSession::help(const Words& words) {
  std::string text;
  if (words.size() == 1) {
    text = commands();
    text.pop_back();
  }
  for (const Entry& entry : table())
    if (words.size() > 1 && words[1] == entry.name)
      text = fmt::format("{}\n{}", entry.usage, entry.summary);
  if (text.empty()) refuse("no command " + in_quotes(words[1]), "one that help lists");
  if (words.size() > 1 && words[1] == "set") text += "\noptions: " + listed(names_of_options());
  if (words.size() > 1 && words[1] == "quit")
    text += "\nA script ends with the exit code of its first error, otherwise of its last check.";
  say(text, Json{{"help", text}}.dump());
  return 0;
}

int ShellSession::quit(const Words&) {
  ended_ = true;
  return 0;
}

ShellNames ShellSession::names() const {
  ShellNames names;
  for (const Entry& entry : table()) names.commands.emplace_back(entry.name);
  names.options = names_of_options();
  names.values_of = [](const std::string& option) {
    const OptionEntry* entry = option_of_check(option);
    return entry == nullptr ? Words{} : entry->choices;
  };
  names.files = files_beginning;
  if (!asked_.model) return names;
  names.motions = motion_names(*asked_.model);
  names.groups = tolerance_groups(*asked_.model);
  names.lets = let_names(asked_.text);
  if (asked_.motion.empty()) return names;
  for (const MotionParameter& p : find_motion(*asked_.model, asked_.motion).parameters)
    names.parameters.push_back(p.name);
  return names;
}

}  // namespace regulus::codegen
