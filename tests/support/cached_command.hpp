// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the command with a cache of its own, and looks at the entries of this cache.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "codegen/kernel/jit/cache/cache_entry.hpp"
#include "tests/support/cache_entries.hpp"
#include "tests/support/command.hpp"
#include "tests/support/files.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {

/// During its lifetime, commands keep their data in a directory that was empty at first.
class CachedCommand {
 public:
  CachedCommand() {
    if (const char* before = std::getenv(kVariable)) before_ = before;
    setenv(kVariable, directory_.path().c_str(), 1);
  }
  ~CachedCommand() {
    before_.empty() ? unsetenv(kVariable) : setenv(kVariable, before_.c_str(), 1);
  }
  CachedCommand(const CachedCommand&) = delete;
  CachedCommand& operator=(const CachedCommand&) = delete;

  /// Adds the engine that waits for the compiler, unless the words name another. Then the cache has
  /// all entries of a run when it ends.
  [[nodiscard]] static std::vector<std::string> words(std::vector<std::string> arguments) {
    if (arguments[0] != "verify" && std::ranges::count(arguments, "--engine") == 0)
      arguments.insert(arguments.end(), {"--engine", "jit"});
    arguments.insert(arguments.begin(), REGULUS_BINARY_DIR "/bin/regulus");
    return arguments;
  }
  [[nodiscard]] CommandResult run(std::vector<std::string> arguments) const {
    return run_command(words(std::move(arguments)));
  }
  [[nodiscard]] nlohmann::json report(std::vector<std::string> arguments) const {
    arguments.emplace_back("--json");
    return nlohmann::json::parse(run(std::move(arguments)).output);
  }

  /// Return the files that hold a warm start of one question, one of all questions with the same
  /// forms, a pack program, or machine code.
  [[nodiscard]] std::vector<std::filesystem::path> problems() const { return entries('{'); }
  [[nodiscard]] std::vector<std::filesystem::path> programs() const { return entries('r'); }
  [[nodiscard]] std::vector<std::filesystem::path> objects() const { return entries('0'); }

  /// From now on no question finds the forms of an earlier one.
  void forget_forms() const {
    for (const auto& file : problems()) std::filesystem::remove(file);
  }

 private:
  [[nodiscard]] std::vector<std::filesystem::path> entries(char kind) const {
    std::vector<std::filesystem::path> found;
    if (!std::filesystem::exists(directory_.path() / "regulus")) return found;
    for (const auto& file : cache_entries(directory_.path() / "regulus")) {
      const std::string bytes = file_contents(file);
      const std::size_t begin = sizeof(CacheEntryHeader);
      const char first = bytes.size() > begin ? bytes[begin] : '0';
      const bool is_text = std::string_view("{r").find(first) != std::string_view::npos;
      if ((is_text ? first : '0') == kind) found.push_back(file);
    }
    return found;
  }

  static constexpr const char* kVariable = "XDG_CACHE_HOME";

  TemporaryDirectory directory_;
  std::string before_;
};

/// Returns a report without the parts that may differ from run to run.
inline nlohmann::json timeless(nlohmann::json report) {
  report.erase("seconds");
  report.erase("cache");
  return report;
}

/// Does the same for the text report.
inline std::string timeless(const std::string& lines) {
  std::string kept;
  for (std::size_t begin = 0; begin < lines.size();) {
    const std::size_t end = std::min(lines.find('\n', begin), lines.size() - 1) + 1;
    std::string line = lines.substr(begin, end - begin);
    begin = end;
    if (line.starts_with("time ")) continue;
    if (line.starts_with("method ")) line = line.substr(0, line.find("cache"));
    kept += line;
  }
  return kept;
}

}  // namespace regulus::detail::test
