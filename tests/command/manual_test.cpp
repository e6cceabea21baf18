// SPDX-License-Identifier: GPL-3.0-or-later
// Manual pages, completions and the page about the shell must describe the program as it is.
#include "codegen/command/manual.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "codegen/shell/shell_session.hpp"
#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus {
namespace {

using regulus::test::run_command;
using testing::HasSubstr;

const std::string kProgram = REGULUS_BINARY_DIR "/bin/regulus";

std::string without_escapes(std::string text) {
  std::erase(text, '\\');
  return text;
}

TEST(Manual, HasEveryOptionThatHelpShows) {
  const std::vector<CommandEntry> table = command_table(ShellSession::commands());
  ASSERT_GE(table.size(), 7U);
  for (const CommandEntry& command : table) {
    std::vector<std::string> words = {kProgram, command.name, "--help"};
    std::erase(words, "");
    std::istringstream help(run_command(words).output);
    const std::string page = without_escapes(manual_page(command, table));
    std::string line;
    while (std::getline(help, line)) {
      const std::size_t at = line.find("--");
      if (at == std::string::npos || at > 6) continue;
      const std::string option = line.substr(at, line.find_first_of(" ,", at) - at);
      EXPECT_THAT(page, HasSubstr("fB" + option + "fR")) << command.name;
    }
  }
}

TEST(Manual, KeepsTheWholeOfAValueThatHasAColon) {
  const std::vector<CommandEntry> table = command_table(ShellSession::commands());
  const auto check = std::ranges::find(table, "check", &CommandEntry::name);
  const std::string page = without_escapes(manual_page(*check, table));
  EXPECT_THAT(page, HasSubstr("fB--rangefR fIp=LO:HIfR"));
  EXPECT_THAT(page, HasSubstr("fB--time-limitfR fISfR"));
  EXPECT_THAT(page, HasSubstr("fB--bisectfR fIwidest|weighted|impactfR"));
}

TEST(Manual, OfTheShellHasItsCommands) {
  const std::vector<CommandEntry> table = command_table(ShellSession::commands());
  const auto shell = std::ranges::find(table, "shell", &CommandEntry::name);
  const std::string page = without_escapes(manual_page(*shell, table));
  for (const char* command : {"\nload MODEL ", "\nedit ", "\nplot FILE.svg|FILE.png"})
    EXPECT_THAT(page, HasSubstr(command));
}

TEST(Manual, HasNoMistakesOfItsMacros) {
  if (run_command({"/bin/sh", "-c", "command -v mandoc"}).exit_code != 0)
    GTEST_SKIP() << "no mandoc";
  const regulus::test::TemporaryDirectory directory;
  const std::vector<CommandEntry> table = command_table(ShellSession::commands());
  for (const CommandEntry& command : table) {
    const std::string file = (directory.path() / "page.1").string();
    std::ofstream(file) << manual_page(command, table);
    EXPECT_EQ(run_command({"/bin/sh", "-c", "mandoc -T lint -W warning " + file}).output, "");
  }
}

TEST(Completions, AreReadByTheirShells) {
  const regulus::test::TemporaryDirectory directory;
  const std::vector<CommandEntry> table = command_table(ShellSession::commands());
  const std::string bash = (directory.path() / "bash").string();
  std::ofstream(bash) << bash_completion(table);
  EXPECT_EQ(run_command({"/bin/bash", "-n", bash}).errors, "");
  const std::string script = "source " + bash +
                             "; COMP_WORDS=(regulus check --method k); COMP_CWORD=3; _regulus; "
                             "echo ${COMPREPLY[@]}; COMP_WORDS=(regulus lo); COMP_CWORD=1; "
                             "_regulus; echo ${COMPREPLY[@]}";
  EXPECT_EQ(run_command({"/bin/bash", "-c", script}).output, "kj kj+rohn kj-numeric\nlocate\n");
  if (access("/usr/bin/zsh", X_OK) != 0) GTEST_SKIP() << "no zsh here";
  const std::string zsh = (directory.path() / "_regulus").string();
  std::ofstream(zsh) << zsh_completion(table);
  EXPECT_EQ(run_command({"/usr/bin/zsh", "-n", zsh}).errors, "");
}

TEST(ShellPage, ShowsASessionThatTakesPlaceLikeThat) {
  std::ifstream page(REGULUS_SOURCE_DIR "/codegen/shell/SHELL.md");
  const std::string prompt = "regulus> ";
  std::string line, script, shown;
  while (std::getline(page, line) && line != "```") continue;
  while (std::getline(page, line) && line != "```")
    (line.starts_with(prompt) ? script : shown) +=
        (line.starts_with(prompt) ? line.substr(prompt.size()) : line) + '\n';
  ASSERT_GT(script.size(), 100U);
  const regulus::test::TemporaryDirectory directory;
  const std::string file = (directory.path() / "script").string();
  std::ofstream(file) << script;
  const auto result = run_command(
      {"/bin/sh", "-c", "cd " REGULUS_SOURCE_DIR " && " + kProgram + " shell < " + file});
  EXPECT_EQ(result.output, shown) << result.errors;
}

TEST(JsonOption, IsTakenByEveryCommand) {
  for (const CommandEntry& command : command_table(ShellSession::commands())) {
    if (command.name.empty()) continue;
    EXPECT_EQ(std::ranges::count(command.options, "--json", &OptionEntry::name), 1) << command.name;
  }
}

}  // namespace
}  // namespace regulus
