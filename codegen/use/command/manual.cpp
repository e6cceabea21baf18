// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/command/manual.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "codegen/use/command/help_layout.hpp"
#include "regulus/version.hpp"

namespace regulus::detail {
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
  return "prove that a robot has no singular pose, or show one";
}

/// The parts of the last lines of --help.
struct Footer {
  std::string result, exit;
};

Footer footer_of(const CommandEntry& command) {
  static const std::string kExit = "Exit: ";
  const std::string& text = command.footer;
  const std::size_t at = text.starts_with(kExit) ? 0 : text.find('\n' + kExit);
  if (at == std::string::npos) return {text, ""};
  std::string exit = text.substr(text.find(kExit, at) + kExit.size());
  exit.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(exit.front())));
  return {text.substr(0, at), exit};
}

std::string options_of(const CommandEntry& command) {
  std::string text;
  for (const OptionEntry& argument : command.arguments) text += item(argument);
  for (const std::string& group : option_groups()) {
    std::string items;
    for (const OptionEntry& option : command.options)
      if (option.group == group) items += item(option);
    const bool is_headed = !items.empty() && group != option_groups().back();
    text += (is_headed ? ".SS " + group + '\n' : "") + items;
  }
  return text;
}

constexpr const char* kFiles = R"(.SH FILES
.TP
\fI~/.cache/regulus\fR
Compiled kernels and prepared searches, below \fBXDG_CACHE_HOME\fR if it is set. It may be removed.
.TP
\fI~/.local/state/regulus/history\fR
The lines of the shell, below \fBXDG_STATE_HOME\fR if it is set.
.TP
\fIshare/regulus/models\fR, \fIshare/regulus/schema\fR, \fIshare/doc/regulus\fR
Below the folder that Regulus is installed in: models, JSON schemas, the manual.
)";

constexpr const char* kEnvironment = R"(.SH ENVIRONMENT
.TP
\fBREGULUS_MODELS\fR
The folder of the models that are named without a path.
.TP
\fBREGULUS_PLUGINS\fR
The folder of the compilers that are loaded at first use.
.TP
\fBNO_COLOR\fR
If it is set and not empty, a terminal gets no colours.
.TP
\fBVISUAL\fR, \fBEDITOR\fR
The editor of the shell's command edit.
.TP
\fBXDG_CACHE_HOME\fR, \fBXDG_STATE_HOME\fR, \fBHOME\fR
See FILES.
)";

std::string see_also(const CommandEntry& command, const std::vector<CommandEntry>& table) {
  std::string text;
  for (const CommandEntry& other : table)
    if (other.name != command.name)
      text += fmt::format("{}\\fB{}\\fR(1)", text.empty() ? "" : ",\n", roff(page_name(other)));
  return text;
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
  page += ".SH OPTIONS\n" + options_of(command);
  const Footer footer = footer_of(command);
  if (!footer.result.empty()) page += ".SH RESULT\n" + laid_out(footer.result);
  page += ".SH EXIT STATUS\n" + laid_out(footer.exit);
  if (!command.examples.empty()) page += ".SH EXAMPLES\n" + laid_out(command.examples);
  return page + kFiles + kEnvironment + ".SH SEE ALSO\n" + see_also(command, table) + "\n";
}

}  // namespace regulus::detail
