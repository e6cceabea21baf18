// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/shell/kept_options.hpp"

#include <algorithm>

#include "codegen/support/errors.hpp"

namespace regulus::inline shell {
namespace {

const CommandEntry& entry_of_check() {
  static const std::vector<CommandEntry> kTable = command_table();
  return *std::ranges::find(kTable, "check", &CommandEntry::name);
}

}  // namespace

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

bool takes_names(const std::string& option) {
  return option == "range" || option == "tolerance" || option == "tube";
}

void refuse(const std::string& found, const std::string& expected) {
  throw UsageError("found " + found + ", expected " + expected);
}

void reject(const std::string& problem, const std::string& remedy) {
  throw UsageError(problem + "; " + remedy);
}

}  // namespace regulus::shell
