// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/shell/shell_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/report_text.hpp"
#include "codegen/answer/report/search_facts.hpp"
#include "codegen/model/file/installed_models.hpp"
#include "codegen/model/file/model_edit.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/model/names.hpp"
#include "codegen/model/overrides.hpp"
#include "codegen/model/request.hpp"
#include "codegen/question/quantity/quantity.hpp"
#include "codegen/support/exit_code.hpp"
#include "codegen/support/shell_word.hpp"
#include "codegen/support/wrapped_text.hpp"
#include "codegen/support/write_file.hpp"
#include "codegen/use/command/run_command_line.hpp"
#include "codegen/use/shell/kept_options.hpp"
#include "codegen/use/shell/shell_words.hpp"
#include "regulus/version.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kListCommands = "help lists the commands";
constexpr std::size_t kColumnOfSummaries = 30, kColumnsOfHelp = 80;

std::vector<std::string> motion_names(const Model& model) {
  std::vector<std::string> names;
  for (const Motion& motion : model.motions) names.push_back(motion.name);
  return names;
}

std::string listed(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, " "));
}

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
      {"load", "load MODEL", "read a model file and discard the settings", &S::load},
      {"list", "list [MODEL]", "list the installed models, or the motions and groups of a model",
       &S::run},
      {"motions", "motions", "list the motions of the model", &S::motions},
      {"motion", "motion NAME", "choose a motion", &S::motion},
      {"show", "show [matrix|forms|occurrences|text|settings]",
       "show the output of explain, or the settings;\n"
       "without a word: the model, the settings, and what else can be shown",
       &S::show},
      {"set", "set OPTION [VALUE]",
       "set an option of check: range p=LO:HI, tolerance G=E, alpha A, method M …;\n"
       "set entry I J EXPR, set let NAME EXPR: change the matrix or a sub-expression;\n"
       "set keep-going on|off, set json on|off",
       &S::set},
      {"edit", "edit", "change the model's text in the editor that EDITOR names", &S::edit},
      {"reload", "reload", "read the model file again and keep the settings", &S::reload},
      {"unset", "unset OPTION [NAME]", "restore the value of the model or the default", &S::unset},
      {"undo", "undo", "take back the last change of the model, the motion or a setting", &S::undo},
      {"check", "check [OPTIONS]", "prove that there is no singular pose, or show one", &S::run},
      {"locate", "locate [OPTIONS]", "pave the motion: free, singular, undecided", &S::run},
      {"margin", "margin OPTIONS",
       "bracket the largest safe value, e.g. margin --tolerance base=0:1", &S::run},
      {"bound", "bound QUANTITY [OPTIONS]",
       "bracket a force, an error, a speed …, e.g. bound force --load payload", &S::run},
      {"datasheet", "datasheet [OPTIONS]", "bracket everything that the model has data for",
       &S::run},
      {"solve", "solve [--at NAME=VALUE] [OPTIONS]",
       "find all configurations, poses or postures at one place", &S::run},
      {"report", "report -o FILE.html [OPTIONS]",
       "run check, and what else is asked, and write a page for a browser", &S::run},
      {"plot", "plot FILE.svg|FILE.png [OPTIONS]", "run locate and draw the result", &S::plot},
      {"verify", "verify FILE", "check a certificate that check --certificate FILE wrote", &S::run},
      {"history", "history", "list the lines of this session", &S::history},
      {"help", "help [COMMAND]", "list the commands, or say more about one", &S::help},
      {"save", "save FILE", "write the model with its changed expressions", &S::save},
      {"quit", "quit", "end the session", &S::quit},
      {"exit", "exit", "end the session, as quit does", &S::quit},
  };
  return kTable;
}

/// At the end of a line, keeps what was asked before it, if the line has changed it; also if the line
/// ends with an error, as where a changed model cannot be compiled.
class ShellSession::KeptForUndo {
 public:
  KeptForUndo(ShellSession& session, const std::string& line, bool undoes)
      : session_(session), change_{session.asked_, line}, undoes_(undoes) {}
  ~KeptForUndo() {
    if (!undoes_ && !(change_.before == session_.asked_))
      session_.changes_.push_back(std::move(change_));
  }
  KeptForUndo(const KeptForUndo&) = delete;
  KeptForUndo& operator=(const KeptForUndo&) = delete;

 private:
  ShellSession& session_;
  Change change_;
  bool undoes_;
};

int ShellSession::execute(const std::string& line) {
  const Words words = split_words(line);
  if (words.empty()) return 0;
  history_.push_back(line);
  std::vector<std::string> known;
  for (const Entry& entry : table()) {
    if (words[0] == entry.name) {
      const KeptForUndo kept(*this, line, entry.run == &ShellSession::undo);
      try {
        return (this->*entry.run)(words);
      } catch (const CommandLineRefused& refused) {
        return refused.code;
      }
    }
    known.emplace_back(entry.name);
  }
  reject("unknown command " + in_quotes(words[0]), suggestion(words[0], known, kListCommands));
}

void ShellSession::say(const std::string& text, const std::string& json) const {
  std::cout << (json_ ? json : text) << '\n' << std::flush;
}

void ShellSession::require_model() const {
  if (!asked_.model) reject("no model is loaded", "first load one: load MODEL");
}

// ---- the model ----

int ShellSession::load(const Words& words) {
  if (words.size() != 2) refuse(rest_of(words, 0), "load MODEL");
  const std::string path = find_model(words[1]);
  std::string text = read_model_text(path);
  Model model = parse_model(text, path);
  asked_.path = path;
  asked_.text = std::move(text);
  asked_.edits.clear();
  draft_.clear();
  asked_.model = std::move(model);
  asked_.motion = asked_.model->motions.size() == 1 ? asked_.model->motions.front().name : "";
  asked_.settings.clear();
  const auto names = motion_names(*asked_.model);
  say(fmt::format("{}: {}×{}, motions {}", asked_.model->name, asked_.model->matrix.rows(),
                  asked_.model->matrix.cols(), listed(names)),
      report_text({{"model", asked_.model->name}, {"path", asked_.path}, {"motions", names}}));
  return 0;
}

int ShellSession::motions(const Words&) {
  require_model();
  const auto names = motion_names(*asked_.model);
  say(fmt::format("{}", fmt::join(names, "\n")), report_text({{"motions", names}}));
  return 0;
}

int ShellSession::motion(const Words& words) {
  require_model();
  if (words.size() != 2) refuse(rest_of(words, 0), "motion NAME");
  from_option("motion", [&] { static_cast<void>(find_motion(*asked_.model, words[1])); });
  asked_.motion = words[1];
  // Ranges belong to the parameters of the motion.
  std::erase_if(asked_.settings, [](const Setting& s) { return s.option == "range"; });
  return 0;
}

int ShellSession::save(const Words& words) {
  require_model();
  if (words.size() != 2) refuse(rest_of(words, 0), "save FILE");
  write_file(words[1], asked_.text);
  return 0;
}

/// Each stage is reused if its own input is the same. If an edit does not change the text of the
/// kernel (after a change of a name), the cache has the whole kernel; otherwise it has the
/// functions that did not change.
int ShellSession::prepare_again() {
  CommandLine line = parsed(asked_, {"check"});
  adopt(line);
  // The kernel of a motion along way-points depends on their file, and is made for each check.
  const Request request = read_request(line.check->model);
  if (request.motion.waypoints || request.model.closure) return 0;
  const PreparedSearch p = prepare(line.check->model, line.check->search);
  const StageSeconds spent = p.seconds_spent();
  const std::size_t functions = p.parts.compiled + p.parts.known;
  const std::string kernel =
      p.cache == "hit" ? "nothing is compiled again: the functions are in the cache"
      : functions == 0 ? "interpreted"
                       : fmt::format("{} of {} functions compiled", p.parts.compiled, functions);
  Facts facts;
  tell_time(spent, facts);
  facts.add("cache", p.cache).add("functions", functions).add("compiled", p.parts.compiled);
  facts.say("kernel", kernel);
  std::string lines = facts.text();
  lines.pop_back();  // say() ends the last line
  say(lines, report_text(facts.object()));
  return 0;
}

int ShellSession::run(const Words& words) {
  if (words[0] != "verify" && words[0] != "list") require_model();
  return run_line(words);
}

int ShellSession::run_line(const Words& words) {
  CommandLine line = parsed(asked_, words);
  adopt(line);
  return run_command_line(line, shell_command(whole_line(asked_, words)));
}

int ShellSession::plot(const Words& words) {
  if (words.size() < 2) refuse("plot", "plot FILE.svg|FILE.png");
  Words located = {"locate", "--picture", words[1]};
  located.insert(located.end(), words.begin() + 2, words.end());
  return run(located);
}

int ShellSession::show(const Words& words) {
  if (words.size() == 1) return show_everything();
  if (words.size() == 2 && words[1] == "settings") return show_settings();
  require_model();
  static const Words kParts = {"matrix", "forms", "occurrences", "text"};
  if (words.size() != 2 || std::ranges::find(kParts, words[1]) == kParts.end())
    refuse(rest_of(words, 0), "show matrix|forms|occurrences|text|settings");
  if (words[1] == "text" && asked_.motion.empty())
    reject("no motion is chosen", "first choose one: motion NAME");
  return run_line({"explain", "--stage", words[1]});
}

int ShellSession::history(const Words&) {
  say(fmt::format("{}", fmt::join(history_, "\n")), report_text({{"history", history_}}));
  return 0;
}

std::string ShellSession::commands() {
  std::string text;
  for (const Entry& entry : table()) {
    const std::string summary = entry.summary;
    std::string first = summary.substr(0, summary.find('\n'));
    if (first.ends_with(';')) first.pop_back();
    // A long usage has a line of its own.
    const bool is_long = std::string_view(entry.usage).size() >= kColumnOfSummaries;
    text += entry.usage +
            (is_long ? "\n" + std::string(kColumnOfSummaries, ' ')
                     : std::string(kColumnOfSummaries - std::string_view(entry.usage).size(), ' '));
    text += wrapped(first, kColumnsOfHelp, kColumnOfSummaries) + '\n';
  }
  return text;
}

/// A command of the command line has its own help; its MODEL and MOTION are those of the session.
std::string ShellSession::help_about(const Entry& entry) {
  std::string text = fmt::format("{}\n{}", entry.usage, entry.summary);
  const std::string name = entry.name;
  if (name == "set") text += "\n\n" + describe_kept_options();
  if (name == "quit" || name == "exit")
    text += "\nA script ends with the exit code of its first error, otherwise of its last check.";
  if (const std::string whole = help_of(name == "plot" ? "locate" : name); !whole.empty())
    text += "\n\nMODEL and MOTION are those of the session; leave them out.\n\n" + whole;
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

int ShellSession::help(const Words& words) {
  std::string text;
  if (words.size() == 1) text = commands() + "help COMMAND says more";
  for (const Entry& entry : table())
    if (words.size() > 1 && words[1] == entry.name) text = help_about(entry);
  if (text.empty()) reject("unknown command " + in_quotes(words[1]), kListCommands);
  text = wrapped_table(text, kColumnsOfHelp);
  say(text, report_text({{"help", text}}));
  return 0;
}

std::string ShellSession::prompt() const {
  if (!asked_.model) return "regulus> ";
  const std::string name = std::filesystem::path(asked_.path).stem().string();
  return fmt::format("regulus {}{}{}{}> ", name, asked_.edits.empty() ? "" : "*",
                     asked_.motion.empty() ? "" : " ", asked_.motion);
}

std::string ShellSession::greeting() const {
  const std::string motion = asked_.motion.empty() && asked_.model && !asked_.model->motions.empty()
                                 ? asked_.model->motions.front().name
                                 : "wide_15";
  std::string text = fmt::format("Regulus {}. Three lines to try:\n", kVersion);
  text += asked_.model ? "  show               the model, its motions and what is set\n"
                       : "  load robot_1       a model file, or an installed model (list)\n";
  if (asked_.motion.empty())
    text += fmt::format("  {:<18} the motion in question\n", "motion " + motion);
  else
    text += "  help set           what can be changed: ranges, tolerances, methods …\n";
  return text +
         "  check              prove that it has no singular pose, or show one\n"
         "Tab completes words, help lists the commands, exit or Ctrl-D ends.\n";
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
  names.options_of = options_of_command;
  names.quantities = quantity_words();
  for (const InstalledModel& installed : installed_models())
    names.installed.push_back(installed.name);
  if (!asked_.model) return names;
  names.motions = motion_names(*asked_.model);
  names.groups = tolerance_groups(*asked_.model);
  names.lets = let_names(asked_.text);
  for (const VectorSet& load : asked_.model->loads) names.loads.push_back(load.name);
  for (const VectorSet& twist : asked_.model->twists) names.twists.push_back(twist.name);
  if (asked_.motion.empty()) return names;
  for (const MotionParameter& p : find_motion(*asked_.model, asked_.motion).parameters)
    names.parameters.push_back(p.name);
  return names;
}

}  // namespace regulus::detail
