// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/command/help_layout.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include "codegen/support/wrapped_text.hpp"

namespace regulus::detail {
namespace {

constexpr const char* kQuestion = "Question";
constexpr const char* kBudget = "Budget";
constexpr const char* kOutput = "Output";
constexpr const char* kResearch = "Research";
constexpr const char* kRest = "Options";

using OptionNames = std::vector<std::string>;

const OptionNames& names_in(const std::string& group) {
  static const std::map<std::string, OptionNames> kNames = {
      {kQuestion,
       {"range",         "tolerance",    "alpha", "waypoints", "tube",     "scale",  "grow",
        "load",          "twist",        "leg",   "freedom",   "min",      "signed", "finite",
        "norm",          "quantity",     "limit", "bound",     "margin",   "paving", "model",
        "base",          "tip",          "cut",   "weld",      "actuated", "at",     "hold",
        "closure",       "snap",         "stage", "box",       "all",      "name",   "namespace",
        "beyond-limits", "allow-options"}},
      {kBudget,
       {"time-limit", "max-boxes", "threads", "gap", "resolution", "precision", "symbolic-budget"}},
      {kOutput,
       {"json", "quiet", "certificate", "shard-size", "checkpoint", "checkpoint-every", "output",
        "page", "picture", "axes", "slices", "shade", "robot", "markdown", "depfile", "object"}},
      {kResearch,
       {"method", "determinant", "entries", "bisect", "weight", "uncertainty", "without", "engine",
        "isa", "filter", "kernel", "no-cache"}}};
  static const OptionNames kNone;
  const auto at = kNames.find(group);
  return at == kNames.end() ? kNone : at->second;
}

bool is_in(const CLI::Option& option, const std::string& group) {
  return std::ranges::any_of(option.get_lnames(), [&](const std::string& name) {
    return std::ranges::find(names_in(group), name) != names_in(group).end();
  });
}

/// Command lines, most with a line about them.
struct Examples {
  std::string_view command;
  const char* lines;
};

constexpr std::array<Examples, 13> kExamples = {
    {{"check",
      "  regulus check robot_1 wide_15\n"
      "      a motion of an installed model\n"
      "  regulus check my.toml --range x=-10:10 --tolerance base,platform=0.05\n"
      "      with another range and other tolerances than the file's\n"
      "  regulus check my.toml --waypoints path.csv --tube x,y=0.1 --json\n"
      "      along way-points, for a script\n"
      "  regulus check my.toml --certificate proof.txt && regulus verify proof.txt\n"
      "      with a proof that separate code checks\n"},
     {"locate",
      "  regulus locate planar_3rpr crossing --resolution 1/64 --picture map.svg --axes x,phi\n"
      "      a picture of the singular poses\n"
      "  regulus locate planar_3rpr crossing --output boxes.jsonl\n"
      "      every box, one JSON object on a line\n"},
     {"margin",
      "  regulus margin robot_1 wide_15 --tolerance base,platform=0:\n"
      "      the largest tolerance of the anchors that is safe\n"
      "  regulus margin orthoglide factors_2 --grow edge=0: --quantity sigma-max --limit 2\n"
      "      the largest cube in which no motor is more than twice as fast as the platform\n"},
     {"bound",
      "  regulus bound orthoglide cube force --load unit\n"
      "      the largest force in a leg, and where it is attained\n"
      "  regulus bound orthoglide cube sigma-min --limit 0.4\n"
      "      WITHIN if every value is above the limit\n"},
     {"datasheet", "  regulus datasheet orthoglide cube --gap 0.05 --markdown\n"},
     {"solve",
      "  regulus solve alias_3rpr --at l1=7 --at l2=5 --at l3=5\n"
      "      all poses of the platform with these legs\n"
      "  regulus solve rpr_6 --waypoints lengths.csv --output poses.jsonl\n"
      "      the same for each line of a table with the columns rho_1, rho_2, rho_3\n"},
     {"report",
      "  regulus report planar_3rpr crossing --output page.html --paving\n"
      "      one page with the verdict, the robot, the boxes and the proof\n"},
     {"explain",
      "  regulus explain robot_1 wide_15\n"
      "      the forms of the first entries, and their occurrences\n"
      "  regulus explain robot_1 wide_15 --box --range x=-1:1\n"
      "      the matrix and its determinant over a box, by each method\n"
      "  regulus explain robot_1 wide_15 --stage text\n"
      "      the C++ text of the kernel\n"},
     {"generate", "  regulus generate robot_1 wide_15 --output kernel\n"},
     {"verify",
      "  regulus verify proof.txt --model my.toml\n"
      "      also check that the proof is about this model\n"},
     {"import", "  regulus import arm.urdf --base base_link --tip tool --output arm.toml\n"},
     {"list",
      "  regulus list\n"
      "  regulus list robot_1\n"},
     {"shell",
      "  regulus shell robot_1\n"
      "      a prompt with the model loaded\n"
      "  regulus shell --json < questions.txt\n"
      "      a script, each result on a line\n"}}};

/// The columns of a help text, and the one in which descriptions begin.
constexpr std::size_t kColumns = 80, kColumnOfDescriptions = 30;

}  // namespace

const std::vector<std::string>& option_groups() {
  static const OptionNames kGroups = {kQuestion, kBudget, kOutput, kResearch, kRest};
  return kGroups;
}

void group_options(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) {
    // An option without a group is one that is refused with a reason.
    if (option->get_positional() || option->get_group().empty()) continue;
    for (const std::string& group : option_groups())
      if (is_in(*option, group)) option->group(group);
  }
}

std::string examples_of(const std::string& command) {
  const auto at = std::ranges::find(kExamples, command, &Examples::command);
  return at == kExamples.end() ? "" : at->lines;
}

std::string without_check(const std::string& type) {
  const std::size_t at = type.find(':');
  if (at == std::string::npos) return type;
  if (type.compare(at + 1, 1, "{") == 0) return type.substr(at + 1);
  return type;
}

std::string GroupedHelp::make_option_opts(const CLI::Option* option) const {
  if (option->get_positional() || option->get_type_size() == 0) return "";
  const std::string type = without_check(option->get_type_name());
  return (type.empty() ? "" : ' ' + type) + (option->get_required() ? " (required)" : "");
}

std::string GroupedHelp::make_option_desc(const CLI::Option* option) const {
  std::string text = option->get_description();
  const std::string value = option->get_default_str();
  if (!value.empty() && text.find("default") == std::string::npos) text += "; default " + value;
  // CLI11 moves each line to the column of descriptions.
  return wrapped(text, kColumns - kColumnOfDescriptions, 0);
}

std::string GroupedHelp::groups_of(const CLI::App& app) const {
  std::string text;
  for (const std::string& group : option_groups()) {
    const std::vector<const CLI::Option*> options = app.get_options(
        [&](const CLI::Option* o) { return o->get_group() == group && o->nonpositional(); });
    if (!options.empty()) text += make_group(group, false, options);
  }
  return text;
}

std::string GroupedHelp::make_help(const CLI::App* app, std::string name,
                                   CLI::AppFormatMode mode) const {
  if (mode == CLI::AppFormatMode::Sub) return make_expanded(app);
  const std::string examples = examples_of(app->get_name());
  return wrapped_table(make_description(app) + '\n' + make_usage(app, std::move(name)) +
                           make_positionals(app) + groups_of(*app) + make_subcommands(app, mode) +
                           '\n',
                       kColumns) +
         (examples.empty() ? "" : "Examples:\n" + examples + '\n') +  // which somebody copies
         wrapped_table(make_footer(app), kColumns);
}

}  // namespace regulus::detail
