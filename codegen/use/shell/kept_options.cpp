// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/shell/kept_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/wrapped_text.hpp"
#include "codegen/use/command/help_layout.hpp"

namespace regulus::detail {
namespace {

constexpr std::size_t kColumns = 80, kIndent = 6;

const std::vector<CommandEntry>& commands() {
  static const std::vector<CommandEntry> kTable = command_table();
  return kTable;
}

const CommandEntry& entry_of_check() {
  return *std::ranges::find(commands(), "check", &CommandEntry::name);
}

}  // namespace

std::vector<std::string> options_of_command(const std::string& command) {
  std::vector<std::string> names;
  const auto at = std::ranges::find(commands(), command, &CommandEntry::name);
  if (command.empty() || at == commands().end()) return names;
  for (const OptionEntry& option : at->options)
    if (option.name.starts_with("--")) names.push_back(option.name);
  return names;
}

const OptionEntry* option_of_check(const std::string& name) {
  const auto& options = entry_of_check().options;
  const auto at = std::ranges::find(options, "--" + name, &OptionEntry::name);
  return at == options.end() ? nullptr : &*at;
}

bool may_be_kept(const std::string& option) {
  static const std::vector<std::string> kNot = {
      "json", "quiet", "help", "certificate", "shard-size", "checkpoint", "checkpoint-every"};
  return std::ranges::find(kNot, option) == kNot.end();
}

std::vector<std::string> names_of_options() {
  std::vector<std::string> names;
  for (const OptionEntry& option : entry_of_check().options)
    if (option.name.starts_with("--") && may_be_kept(option.name.substr(2)))
      names.push_back(option.name.substr(2));
  return names;
}

std::string describe_kept_options() {
  std::string text;
  for (const std::string& group : option_groups()) {
    std::string lines;
    for (const OptionEntry& option : entry_of_check().options) {
      if (option.group != group || !option.name.starts_with("--")) continue;
      const std::string name = option.name.substr(2);
      if (!may_be_kept(name)) continue;
      const std::string value = option.choices.empty() || name == "without"
                                    ? option.value
                                    : fmt::format("{}", fmt::join(option.choices, "|"));
      lines += fmt::format("  {}{}{}\n      {}\n", name, value.empty() ? "" : " ", value,
                           wrapped(option.description, kColumns, kIndent));
    }
    if (!lines.empty()) text += group + ":\n" + lines;
  }
  return text;
}

bool takes_names(const std::string& option) {
  return option == "range" || option == "tolerance" || option == "tube";
}

void refuse(const std::string& found, const std::string& expected) {
  throw UsageError("found " + in_quotes(found) + "; use it as " + expected);
}

void reject(const std::string& problem, const std::string& remedy) {
  throw UsageError(problem + "; " + remedy);
}

}  // namespace regulus::detail
