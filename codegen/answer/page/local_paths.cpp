// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/page/local_paths.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <nlohmann/json.hpp>

#include "codegen/support/shell_word.hpp"

namespace regulus::detail {
namespace {

constexpr std::array<std::string_view, 9> kFileOptions = {
    "--page",    "-o",       "--output", "--certificate", "--checkpoint",
    "--picture", "--filter", "--kernel", "--waypoints"};

std::string_view file_name(std::string_view path) { return path.substr(path.rfind('/') + 1); }

/// A quotient such as x/y is no path: a file in a folder has an extension, or begins at the root.
bool is_path(std::string_view word) {
  const std::size_t folder = word.rfind('/');
  if (folder == std::string_view::npos || folder + 1 == word.size()) return false;
  const std::size_t dot = word.rfind('.');
  const bool has_extension = dot != std::string_view::npos && dot > folder &&
                             dot + 1 < word.size() &&
                             std::isalpha(static_cast<unsigned char>(word[dot + 1])) != 0;
  return word.front() == '/' || has_extension;
}

/// True if a path, or a quotient, could go on to the left of a place.
bool continues_path(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
         std::string_view("/._-)").find(c) != std::string_view::npos;
}

}  // namespace

LocalPaths::LocalPaths(const ModelOptions& model, std::string_view typed) {
  add(model.path);
  add(model.waypoints);
  std::string before;
  for (const std::string& word : words_of_command(typed)) {
    const std::size_t equals = word.find('=');
    const std::string_view option = std::string_view(word).substr(0, equals);
    if (std::ranges::find(kFileOptions, before) != kFileOptions.end() || word.ends_with(".toml"))
      add(word);
    else if (equals != std::string::npos &&
             std::ranges::find(kFileOptions, option) != kFileOptions.end())
      add(std::string_view(word).substr(equals + 1));
    before = word;
  }
}

void LocalPaths::add(std::string_view path) {
  if (!is_path(path)) return;
  paths_.emplace_back(path);
  // In a command its quotes are written otherwise.
  if (path.find('\'') != std::string_view::npos) {
    const std::string quoted = shell_word(path);
    paths_.push_back(quoted.substr(1, quoted.size() - 2));
  }
  std::ranges::sort(paths_, std::ranges::greater{}, &std::string::size);
}

void LocalPaths::remove_from(std::string& text) const {
  for (const std::string& path : paths_)
    for (std::size_t at = text.find(path); at != std::string::npos; at = text.find(path, at + 1))
      if (at == 0 || !continues_path(text[at - 1])) text.replace(at, path.size(), file_name(path));
}

void LocalPaths::remove_from(nlohmann::ordered_json& report) const {
  if (report.is_string()) remove_from(report.get_ref<std::string&>());
  if (report.is_structured())
    for (nlohmann::ordered_json& part : report) remove_from(part);
}

}  // namespace regulus::detail
