// SPDX-License-Identifier: GPL-3.0-or-later
// Manual pages, completions and the page about the shell must describe the program as it is.
#include "codegen/use/command/manual.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "codegen/use/command/completion.hpp"
#include "codegen/use/command/help_layout.hpp"
#include "codegen/use/shell/shell_session.hpp"
#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;

std::string without_escapes(std::string text) {
  std::erase(text, '\\');
  return text;
}

TEST(Manual, HasEveryOptionThatHelpShows) {
  const std::vector<CommandEntry> table = command_table(ShellSession::commands());
  ASSERT_GE(table.size(), 7U);
  for (const CommandEntry& command : table) {
    std::vector<std::string> words = {kCommand, command.name, "--help"};
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
  const TemporaryDirectory directory;
  const std::vector<CommandEntry> table = command_table(ShellSession::commands());
  for (const CommandEntry& command : table) {
    const std::string file = (directory.path() / "page.1").string();
    std::ofstream(file) << manual_page(command, table);
    EXPECT_EQ(run_command({"/bin/sh", "-c", "mandoc -T lint -W warning " + file}).output, "");
  }
}

TEST(Completions, AreReadByTheirShells) {
  const TemporaryDirectory directory;
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

/// Returns what bash offers at the end of these words.
std::string bash_offers(const std::string& file, const std::string& words) {
  const std::string script = "PATH=" REGULUS_BINARY_DIR "/bin:$PATH; source " + file +
                             "; COMP_WORDS=(" + words +
                             "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _regulus; "
                             "echo ${COMPREPLY[@]}";
  return run_command({"/bin/bash", "-c", script}).output;
}

TEST(Completions, OfferTheNamesOfTheModelOnTheLine) {
  const TemporaryDirectory directory;
  const std::string bash = (directory.path() / "bash").string();
  std::ofstream(bash) << bash_completion(command_table());
  const std::string planar = "regulus check " REGULUS_SOURCE_DIR "/models/planar_3rpr.toml ";
  EXPECT_EQ(bash_offers(bash, planar + "''"), "circle crossing disk reach regular\n");
  EXPECT_EQ(bash_offers(bash, planar + "cr"), "crossing\n");
  EXPECT_EQ(bash_offers(bash, planar + "circle --range ''"), "T=\n");
  EXPECT_EQ(bash_offers(bash, planar + "crossing --range ''"), "phi= x= y=\n");
  EXPECT_EQ(bash_offers(bash, planar + "--range ''"), "T= phi= x= y=\n");
  EXPECT_EQ(bash_offers(bash, planar + "regular --tolerance ''"), "base= platform=\n");
  const std::string ortho = "regulus bound " REGULUS_SOURCE_DIR "/models/orthoglide.toml cube ";
  EXPECT_EQ(bash_offers(bash, ortho + "sigma-"), "sigma-min sigma-max\n");
  EXPECT_EQ(bash_offers(bash, ortho + "force --load ''"), "unit\n");
  EXPECT_EQ(bash_offers(bash, "regulus check /no/such/model ''"), "\n");
}

TEST(Help, HasItsOptionsInGroups) {
  for (const CommandEntry& command : command_table()) {
    if (command.name.empty()) continue;
    for (const OptionEntry& option : command.options)
      if (option.name != "--help") {
        EXPECT_NE(option.group, option_groups().back()) << command.name << ' ' << option.name;
      }
  }
  const std::string help = regulus({"check", "--help"}).output;
  std::size_t at = 0;
  for (const char* head : {"\nQuestion:\n", "\nBudget:\n", "\nOutput:\n", "\nResearch:\n",
                           "\nOptions:\n", "Examples:\n", "Exit: "}) {
    at = help.find(head, at);
    ASSERT_NE(at, std::string::npos) << head;
  }
}

TEST(Help, HasExamplesThatAreUnderstood) {
  for (const CommandEntry& command : command_table()) {
    if (command.name.empty()) continue;
    std::istringstream lines(command.examples);
    std::string line, known;
    for (int examples = 0; std::getline(lines, line);) {
      if (!line.starts_with("  regulus ")) continue;
      std::vector<std::string> words;
      std::istringstream split(line.substr(0, line.find_first_of("&<")));
      for (std::string word; split >> word;) words.push_back(word);
      std::vector<const char*> arguments;
      for (const std::string& word : words) arguments.push_back(word.c_str());
      EXPECT_FALSE(
          parse_command_line(static_cast<int>(arguments.size()), arguments.data()).exit_code)
          << line;
      EXPECT_EQ(words[1], command.name);
      known += std::to_string(++examples);
    }
    EXPECT_FALSE(known.empty()) << command.name;
  }
}

TEST(Manual, HasTheSectionsOfAPage) {
  const std::vector<CommandEntry> table = command_table(ShellSession::commands());
  for (const CommandEntry& command : table) {
    const std::string page = manual_page(command, table);
    for (const char* section : {"EXIT STATUS\n.nf\n", "FILES", "ENVIRONMENT", "SEE ALSO"})
      EXPECT_THAT(page, HasSubstr(std::string(".SH ") + section)) << command.name;
    EXPECT_EQ(page.find(".SH EXAMPLES") != std::string::npos, !command.name.empty());
    EXPECT_THAT(page, testing::Not(HasSubstr("EXIT STATUS\n.nf\n\n"))) << command.name;
  }
}

TEST(ShellPage, ShowsASessionThatTakesPlaceLikeThat) {
  std::ifstream page(REGULUS_SOURCE_DIR "/codegen/use/shell/SHELL.md");
  std::string line, script, shown;
  while (std::getline(page, line) && line != "```") continue;
  while (std::getline(page, line) && line != "```")
    if (const std::size_t end = line.find("> "); line.starts_with("regulus") && end < line.size())
      script += line.substr(end + 2) + '\n';
    else
      shown += line + '\n';
  ASSERT_GT(script.size(), 100U);
  const TemporaryDirectory directory;
  const std::string file = (directory.path() / "script").string();
  std::ofstream(file) << script;
  const auto result = run_command(
      {"/bin/sh", "-c", "cd " REGULUS_SOURCE_DIR " && " + kCommand + " shell < " + file});
  EXPECT_EQ(result.output, shown) << result.errors;
}

TEST(OptionsOfScripts, AreTakenByEveryCommand) {
  for (const CommandEntry& command : command_table(ShellSession::commands())) {
    if (command.name.empty()) continue;
    EXPECT_EQ(std::ranges::count(command.options, "--json", &OptionEntry::name), 1) << command.name;
    EXPECT_EQ(std::ranges::count(command.options, "--quiet", &OptionEntry::name),
              command.name == "shell" ? 0 : 1)
        << command.name;
  }
}

}  // namespace
}  // namespace regulus::detail::test
