// SPDX-License-Identifier: GPL-3.0-or-later
// Writes manual pages and completions below a folder, as they are installed below share/; or, with
// --what-works, the page WHAT_WORKS.md to standard output.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string_view>

#include "codegen/answer/refusals.hpp"
#include "codegen/use/command/completion.hpp"
#include "codegen/use/command/manual.hpp"
#include "codegen/use/shell/shell_session.hpp"

namespace {

bool write(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  file << text;
  return static_cast<bool>(file.flush());
}

}  // namespace

int main(int argc, char** argv) {
  using namespace regulus;
  using namespace regulus::detail;
  const std::string_view word = argc == 2 ? argv[1] : "";
  if (word == "--what-works") {
    std::cout << what_works();
    return std::cout.flush() ? 0 : 74;
  }
  if (word.empty() || word.starts_with("-")) {
    std::cerr << "usage: regulus_write_manual FOLDER | --what-works\n";
    return word == "--help" || word == "-h" ? 0 : 64;
  }
  const std::filesystem::path share = word;
  const std::vector<CommandEntry> table = command_table(ShellSession::commands());
  bool written = write(share / "bash-completion/completions/regulus", bash_completion(table)) &&
                 write(share / "zsh/site-functions/_regulus", zsh_completion(table));
  for (const CommandEntry& command : table) {
    const std::string name = command.name.empty() ? "regulus" : "regulus-" + command.name;
    written = write(share / "man/man1" / (name + ".1"), manual_page(command, table)) && written;
  }
  if (!written) std::cerr << "cannot write below " << share << '\n';
  return written ? 0 : 74;
}
