// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/shell/shell_completion.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace regulus::detail {
namespace {

using Words = std::vector<std::string>;

/// The word at the cursor, and the words before it.
struct TypedLine {
  Words before;
  std::string last;
};

TypedLine typed_line(std::string_view line) {
  TypedLine typed;
  for (const char c : line) {
    if (c != ' ' && c != '\t')
      typed.last += c;
    else if (!typed.last.empty())
      typed.before.push_back(std::exchange(typed.last, {}));
  }
  return typed;
}

Words with(const Words& words, const char* ending) {
  Words result;
  for (const std::string& word : words) result.push_back(word + ending);
  return result;
}

Words changeable(const ShellNames& names) {
  Words words = names.options;
  words.insert(words.end(), {"entry", "let", "keep-going", "json"});
  return words;
}

/// Returns what may follow an option, given without its dashes.
Words values_after(const std::string& option, const ShellNames& names) {
  if (option == "range" || option == "grow" || option == "tube" || option == "slices")
    return with(names.parameters, "=");
  if (option == "tolerance" || option == "margin") return with(names.groups, "=");
  if (option == "load") return names.loads;
  if (option == "twist") return names.twists;
  return names.values_of ? names.values_of(option) : Words{};
}

Words of_command(const TypedLine& typed, const ShellNames& names) {
  const std::string& command = typed.before.front();
  const std::string& previous = typed.before.back();
  if (typed.last.starts_with("-")) return names.options_of ? names.options_of(command) : Words{};
  if (previous.starts_with("--")) return values_after(previous.substr(2), names);
  return command == "bound" && typed.before.size() == 1 ? names.quantities : Words{};
}

Words of_set(const TypedLine& typed, const ShellNames& names) {
  if (typed.before.size() == 1) return changeable(names);
  if (typed.before.size() != 2) return {};
  const std::string& what = typed.before[1];
  if (what == "let") return names.lets;
  if (what == "keep-going" || what == "json") return {"off", "on"};
  return values_after(what, names);
}

/// Returns model files, and folders that may contain them.
Words models_among(Words files) {
  std::erase_if(files, [](const std::string& file) {
    return !file.ends_with(".toml") && !file.ends_with("/");
  });
  return files;
}

Words models_to_load(Words files, const Words& installed) {
  Words words = models_among(std::move(files));
  words.insert(words.end(), installed.begin(), installed.end());
  return words;
}

Words candidates(const TypedLine& typed, const ShellNames& names) {
  if (typed.before.empty()) return names.commands;
  const std::string& command = typed.before[0];
  const auto files = [&] { return names.files ? names.files(typed.last) : Words{}; };
  if (command == "load" || command == "list") return models_to_load(files(), names.installed);
  if (command == "plot" || command == "verify" || command == "save") return files();
  if (command == "set" || command == "unset") return of_set(typed, names);
  if (command == "motion") return names.motions;
  if (command == "help") return names.commands;
  if (command == "show") return {"forms", "matrix", "occurrences", "settings", "text"};
  return of_command(typed, names);
}

}  // namespace

std::vector<std::string> completions(std::string_view line, const ShellNames& names) {
  const TypedLine typed = typed_line(line);
  Words result = candidates(typed, names);
  std::erase_if(result, [&](const std::string& word) { return !word.starts_with(typed.last); });
  std::ranges::sort(result);
  return result;
}

std::string common_beginning(const std::vector<std::string>& words) {
  if (words.empty()) return {};
  std::string common = words.front();
  for (const std::string& word : words) {
    const auto [end, unused] = std::ranges::mismatch(common, word);
    common.erase(end, common.end());
  }
  return common;
}

std::vector<std::string> files_beginning(const std::string& prefix) {
  const std::size_t slash = prefix.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : prefix.substr(0, slash + 1);
  Words found;
  std::error_code error;
  std::filesystem::directory_iterator at(folder.empty() ? "." : folder, error), end;
  for (; !error && at != end; at.increment(error)) {
    const std::string path = folder + at->path().filename().string();
    std::error_code unknown;
    if (path.starts_with(prefix)) found.push_back(at->is_directory(unknown) ? path + '/' : path);
  }
  return found;
}

}  // namespace regulus::detail
