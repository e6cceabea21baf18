// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/command/manual.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "regulus/version.hpp"

namespace regulus::inline command {
namespace {

constexpr const char* kDate = "2026-11-21";  // of the manual, by hand: pages are reproducible

std::string page_name(const CommandEntry& command) {
  return command.name.empty() ? "regulus" : "regulus-" + command.name;
}

/// Escapes everything that roff would read as a command.
std::string roff(const std::string& text) {
  std::string result;
  bool line_begins = true;
  for (const char c : text) {
    if (line_begins && (c == '.' || c == '\'')) result += "\\&";
    line_begins = c == '\n';
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
  }
  return result;
}

/// Keeps lines as they are, because they are laid out by hand.
std::string laid_out(const std::string& text) { return fmt::format(".nf\n{}\n.fi\n", roff(text)); }

std::string value_of(const OptionEntry& option) {
  if (option.value.empty() || option.name == "--without") return option.value;
  return option.choices.empty() ? option.value : fmt::format("{}", fmt::join(option.choices, "|"));
}

std::string item(const OptionEntry& option) {
  const std::string value = value_of(option);
  return fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", roff(option.name),
                     value.empty() ? "" : fmt::format(" \\fI{}\\fR", roff(value)),
                     roff(option.description));
}

std::string synopsis(const CommandEntry& command) {
  if (command.name.empty()) return "\\fBregulus\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR]";
  std::string text = "\\fBregulus " + command.name + "\\fR";
  for (const OptionEntry& argument : command.arguments)
    text += argument.required ? fmt::format(" \\fI{}\\fR", roff(argument.name))
                              : fmt::format(" [\\fI{}\\fR]", roff(argument.name));
  return text + " [\\fIOPTIONS\\fR]";
}

std::string first_words(const CommandEntry& command) {
  if (!command.name.empty()) return command.description;
  return "prove that a parallel robot has no singular pose, or show one";
}

std::string see_also(const CommandEntry& command, const std::vector<CommandEntry>& table) {
  std::string text;
  for (const CommandEntry& other : table)
    if (other.name != command.name)
      text += fmt::format("{}\\fB{}\\fR(1)", text.empty() ? "" : ",\n", roff(page_name(other)));
  return text;
}

std::string long_names(const CommandEntry& command) {
  std::string names;
  for (const OptionEntry& option : command.options) {
    const bool is_long = option.name.starts_with("--");
    if (is_long) names += (names.empty() ? "" : " ") + option.name;
  }
  return names;
}

/// Returns the text in single quotes for a shell.
std::string in_single_quotes(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// Returns the text between brackets in a zsh specification.
std::string zsh_words(const std::string& text) {
  std::string result;
  for (const char c : text.substr(0, text.find('\n'))) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

std::string zsh_option(const OptionEntry& option) {
  std::string spec = "*" + option.name;
  spec += fmt::format("[{}]", zsh_words(option.description));
  if (option.value.empty()) return in_single_quotes(spec);
  spec += fmt::format(":{}:", zsh_words(option.value));
  return in_single_quotes(spec + (option.choices.empty()
                                      ? "_files"
                                      : fmt::format("({})", fmt::join(option.choices, " "))));
}

}  // namespace

std::string manual_page(const CommandEntry& command, const std::vector<CommandEntry>& table) {
  std::string page = fmt::format(
      ".\\\" SPDX-License-Identifier: GPL-3.0-or-later\n.TH {} 1 {} \"Regulus {}\" \"Regulus\"\n",
      page_name(command), kDate, kVersion);
  page +=
      fmt::format(".SH NAME\n{} \\- {}\n", roff(page_name(command)), roff(first_words(command)));
  page += ".SH SYNOPSIS\n" + synopsis(command) + "\n";
  if (command.name.empty()) page += ".SH DESCRIPTION\n" + laid_out(command.description);
  if (command.name.empty()) {
    page += ".SH COMMANDS\n";
    for (const CommandEntry& other : table)
      if (!other.name.empty())
        page += fmt::format(".TP\n\\fB{}\\fR\n{}\n", other.name, roff(other.description));
  }
  page += ".SH OPTIONS\n";
  for (const OptionEntry& argument : command.arguments) page += item(argument);
  for (const OptionEntry& option : command.options) page += item(option);
  if (!command.footer.empty()) page += ".SH RESULT\n" + laid_out(command.footer);
  return page + ".SH SEE ALSO\n" + see_also(command, table) + "\n";
}

std::string bash_completion(const std::vector<CommandEntry>& table) {
  std::string commands, cases, values;
  for (const CommandEntry& command : table) {
    if (command.name.empty()) continue;
    commands += (commands.empty() ? "" : " ") + command.name;
    cases += fmt::format("    {}) options=\"{}\" ;;\n", command.name, long_names(command));
    for (const OptionEntry& option : command.options)
      if (!option.choices.empty())
        values += fmt::format("    {}:{}) choices=\"{}\" ;;\n", command.name, option.name,
                              fmt::join(option.choices, " "));
  }
  return fmt::format(R"bash(# SPDX-License-Identifier: GPL-3.0-or-later
_regulus() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} command=${{COMP_WORDS[1]}}
  local options="" choices=""
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    COMPREPLY=($(compgen -W "{} --help --version" -- "$word"))
    return
  fi
  case $command in
{}  esac
  case $command:$before in
{}  esac
  if [[ -n $choices ]]; then
    COMPREPLY=($(compgen -W "$choices" -- "$word"))
  elif [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
  else
    COMPREPLY=($(compgen -f -- "$word"))
    if ((COMP_CWORD == 2)) && [[ $command != verify ]]; then
      COMPREPLY+=($(compgen -W "$(regulus list 2>/dev/null | cut -d' ' -f1)" -- "$word"))
    fi
  fi
}}
complete -o filenames -F _regulus regulus
)bash",
                     commands, cases, values);
}

std::string zsh_completion(const std::vector<CommandEntry>& table) {
  std::string commands, cases;
  for (const CommandEntry& command : table) {
    if (command.name.empty()) continue;
    commands +=
        "    " + in_single_quotes(command.name + ":" + zsh_words(command.description)) + "\n";
    cases += "    " + command.name + ") _arguments";
    for (const OptionEntry& option : command.options)
      if (option.name.starts_with("--")) cases += " \\\n      " + zsh_option(option);
    // The first argument of most commands is a model.
    const bool takes_model =
        !command.arguments.empty() && command.arguments.front().name == "MODEL";
    if (takes_model) cases += " \\\n      '1:model:_regulus_models'";
    cases += " \\\n      '*:file:_files' ;;\n";
  }
  return fmt::format(R"zsh(#compdef regulus
# SPDX-License-Identifier: GPL-3.0-or-later
_regulus_models() {{
  local -a models=(${{(f)"$(regulus list 2>/dev/null | cut -d' ' -f1)"}})
  _alternative 'models:installed model:compadd -a models' 'files:file:_files'
}}
_regulus() {{
  local -a commands=(
{}  )
  if ((CURRENT == 2)); then
    _describe command commands
    return
  fi
  local command=$words[2]
  shift words
  ((CURRENT--))
  case $command in
{}  esac
}}
_regulus "$@"
)zsh",
                     commands, cases);
}

}  // namespace regulus::command
