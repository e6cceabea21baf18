// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/command/completion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "codegen/question/quantity/quantity.hpp"

namespace regulus::detail {
namespace {

/// An option whose value begins with a name of the model.
struct NamingOption {
  const char* name;
  const char* kind;
};

constexpr std::array<NamingOption, 9> kNamingOptions = {{{"--range", "parameters"},
                                                         {"--grow", "parameters"},
                                                         {"--tube", "parameters"},
                                                         {"--slices", "parameters"},
                                                         {"--axes", "axes"},
                                                         {"--tolerance", "groups"},
                                                         {"--margin", "groups"},
                                                         {"--load", "loads"},
                                                         {"--twist", "twists"}}};

const char* kind_named_by(const std::string& option) {
  const auto* const at = std::ranges::find(kNamingOptions, option, &NamingOption::name);
  return at == kNamingOptions.end() ? "" : at->kind;
}

/// Prints the names, for bash and zsh: $1 is the kind, $model and $motion are those of the line. The
/// lines are those of `regulus list MODEL`.
constexpr const char* kNamesOfKind = R"sh(  local name='[A-Za-z][A-Za-z0-9_]*' of=''
  [[ -n $motion ]] && of="/^motion  *$motion\$/,/^[a-z]/"
  local lines
  case $1 in
    motions) lines='s/^motion  *//p' ;;
    parameters) lines="$of s/^  *\\($name\\) in \\[.*/\\1=/p" ;;
    axes) lines="$of s/^  *\\($name\\) in \\[.*/\\1/p" ;;
    groups) lines='s/^group  *\([^:]*\):.*/\1=/p' ;;
    loads) lines='s/^load  *\([^:]*\):.*/\1/p' ;;
    twists) lines='s/^twist  *\([^:]*\):.*/\1/p' ;;
  esac
  regulus list "$model" 2>/dev/null | sed -n "$lines" | sort -u
)sh";

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
  const char* const kind = kind_named_by(option.name);
  return in_single_quotes(spec + (!option.choices.empty()
                                      ? fmt::format("({})", fmt::join(option.choices, " "))
                                  : *kind != '\0' ? fmt::format("_regulus_names {}", kind)
                                                  : "_files"));
}

}  // namespace

std::string bash_completion(const std::vector<CommandEntry>& table) {
  std::string commands, cases, values, named;
  for (const NamingOption& option : kNamingOptions)
    named += fmt::format("    {}) choices=$(_regulus_names {}) ;;\n", option.name, option.kind);
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
# Prints the names of a kind in the model on the line.
_regulus_names() {{
  local model=${{COMP_WORDS[2]/#\~\//$HOME/}} motion=${{COMP_WORDS[3]}}
  [[ $motion == -* ]] && motion=""
{}}}
_regulus() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} command=${{COMP_WORDS[1]}}
  local options="" choices="" more=""
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    COMPREPLY=($(compgen -W "{} --help --version" -- "$word"))
    return
  fi
  case $command in
{}  esac
  [[ $command == bound ]] && more="{}"
  case $command:$before in
{}  esac
  case $before in
{}  esac
  if [[ -n $choices ]]; then
    COMPREPLY=($(compgen -W "$choices" -- "$word"))
    if [[ ${{COMPREPLY[0]}} == *= ]]; then compopt -o nospace 2>/dev/null; fi
  elif [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
  elif ((COMP_CWORD == 3)) && [[ $command != verify && $command != import ]]; then
    COMPREPLY=($(compgen -W "$(_regulus_names motions) $more" -- "$word"))
  elif ((COMP_CWORD == 4)) && [[ -n $more ]]; then
    COMPREPLY=($(compgen -W "$more" -- "$word"))
  else
    COMPREPLY=($(compgen -f -- "$word"))
    if ((COMP_CWORD == 2)) && [[ $command != verify ]]; then
      COMPREPLY+=($(compgen -W "$(regulus list 2>/dev/null | cut -d' ' -f1)" -- "$word"))
    fi
  fi
}}
complete -o filenames -F _regulus regulus
)bash",
                     kNamesOfKind, commands, cases, fmt::join(quantity_words(), " "), values,
                     named);
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
    if (takes_model)
      cases += " \\\n      '1:model:_regulus_models' '2:motion:_regulus_names motions'";
    cases += " \\\n      '*:file:_files' ;;\n";
  }
  return fmt::format(R"zsh(#compdef regulus
# SPDX-License-Identifier: GPL-3.0-or-later
_regulus_models() {{
  local -a models=(${{(f)"$(regulus list 2>/dev/null | cut -d' ' -f1)"}})
  _alternative 'models:installed model:compadd -a models' 'files:file:_files'
}}
# Adds the names of a kind in the model on the line.
_regulus_names() {{
  local model=${{words[2]/#\~\//$HOME/}} motion=$words[3]
  [[ $motion == -* ]] && motion=""
  local -a names=(${{(f)"$(_regulus_print_names $1)"}})
  compadd -S '' -a names
}}
_regulus_print_names() {{
{}}}
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
                     kNamesOfKind, commands, cases);
}

}  // namespace regulus::detail
