// SPDX-License-Identifier: GPL-3.0-or-later
// The settings of a session, and their use in commands.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/model_report.hpp"
#include "codegen/answer/report/report_text.hpp"
#include "codegen/model/names.hpp"
#include "codegen/model/request.hpp"
#include "codegen/use/command/terminal.hpp"
#include "codegen/use/shell/kept_options.hpp"
#include "codegen/use/shell/shell_session.hpp"
#include "codegen/use/shell/shell_words.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

bool switched_on(const std::vector<std::string>& words) {
  if (words.size() == 3 && words[2] == "on") return true;
  if (words.size() == 3 && words[2] == "off") return false;
  refuse(rest_of(words, 0), "set " + words[1] + " on|off");
}

}  // namespace

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
  if (words.size() < 2)
    return show_settings("set OPTION [VALUE] sets an option; help set lists them\n");
  const std::string& what = words[1];
  if (what == "entry" || what == "let") return change_expression(words);
  if (what == "keep-going") return keep_going_ = switched_on(words), 0;
  if (what == "json") return json_ = switched_on(words), 0;
  const OptionEntry* option = option_of_check(what);
  if (option == nullptr || !may_be_kept(what)) {
    if (option != nullptr)
      reject("set cannot keep the option " + in_quotes(what), "give it to the command itself");
    reject("unknown option " + in_quotes(what),
           suggestion(what, names_of_options(), "help set lists the options"));
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
    reject(in_quotes(rest_of(words, 1)) + " is not set", "show settings lists what is set");
  change({words[1], words.size() == 3 ? words[2] : "", ""}, false);
  return 0;
}

int ShellSession::show_everything() {
  const int code = show_settings();
  if (json_) return code;
  if (!asked_.model)
    std::cout << "nothing else: load MODEL reads one, list names those that are installed\n";
  else
    std::cout << for_file(STDOUT_FILENO, format_model(*asked_.model))
              << "show matrix, forms, occurrences or text shows its expressions\n";
  std::cout.flush();
  return code;
}

int ShellSession::show_settings(const std::string& before) {
  Json json{{"model", asked_.path}, {"motion", asked_.motion}, {"settings", Json::array()}};
  std::string text =
      fmt::format("{}model {}\nmotion {}", before, asked_.path.empty() ? "none" : asked_.path,
                  asked_.motion.empty() ? "none" : asked_.motion);
  for (const std::string& edit : asked_.edits) text += "\nchanged " + edit;
  json["changed"] = asked_.edits;
  for (const Setting& s : asked_.settings) {
    text += fmt::format("\n{}{}{}", s.option, s.value.empty() ? "" : " ", s.value);
    json["settings"].push_back({{"option", s.option}, {"value", s.value}});
  }
  say(text, report_text(json));
  return 0;
}

/// Leaves out settings that the command does not know.
ShellSession::Words ShellSession::whole_line(const Asked& asked, const Words& words) {
  static const std::vector<CommandEntry> kTable = command_table();
  const auto& options = std::ranges::find(kTable, words[0], &CommandEntry::name)->options;
  Words line = {"regulus", words[0]};
  if (words[0] != "verify" && words[0] != "list") {
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
  return line;
}

CommandLine ShellSession::parsed(const Asked& asked, const Words& words) {
  const Words line = whole_line(asked, words);
  std::vector<const char*> arguments;
  for (const std::string& word : line) arguments.push_back(word.c_str());
  CommandLine result = parse_command_line(static_cast<int>(arguments.size()), arguments.data());
  if (result.exit_code) throw CommandLineRefused{*result.exit_code};
  return result;
}

/// Uses the model in memory. Compiles its kernel before the search: the parts of earlier kernels
/// are compiled already, and the process keeps them.
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
  if (line.margin) with(line.margin->model, line.margin->output), wait(line.margin->search);
  if (line.bound) with(line.bound->model, line.bound->output), wait(line.bound->search);
  if (line.datasheet)
    with(line.datasheet->model, line.datasheet->output), wait(line.datasheet->search);
  if (line.solve) with(line.solve->model, line.solve->output), wait(line.solve->search);
  if (line.report) with(line.report->model, line.report->output), wait(line.report->search);
  if (line.explain) with(line.explain->model, line.explain->output);
  if (line.generate) {
    line.generate->model.text = asked_.text;
    line.generate->json = line.generate->json || json_;
    line.generate->json_indent = json_ ? -1 : line.generate->json_indent;
  }
  if (line.list) line.list->json = line.list->json || json_;
  if (!line.verify) return;
  line.verify->output.json = line.verify->output.json || json_;
  line.verify->output.json_indent = json_ ? -1 : line.verify->output.json_indent;
}

}  // namespace regulus::detail
