// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/model/model_edit.hpp"

#include <toml++/toml.h>

#include <algorithm>

#include "regulus/codegen/model/errors.hpp"
#include "regulus/codegen/model/names.hpp"
#include "regulus/codegen/model/written.hpp"

namespace regulus::codegen {
namespace {

toml::table document(const std::string& text) try {
  return toml::parse(text);
} catch (const toml::parse_error& error) {
  throw InputError("", static_cast<int>(error.source().begin.line), "text that is not TOML",
                   "TOML 1.0");
}

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U; }

/// Positions of toml++ count lines and characters, from 1.
std::size_t offset_of(const std::string& text, const toml::source_position& position) {
  std::size_t at = 0;
  for (toml::source_index line = 1; line < position.line; ++line) at = text.find('\n', at) + 1;
  for (toml::source_index column = 1; column < position.column; ++column) do
      ++at;
    while (at < text.size() && continues_character(text[at]));
  return at;
}

/// Where the string or number that begins there ends.
std::size_t end_of_value(const std::string& text, std::size_t begin) {
  const char quote = text[begin];
  if (quote != '"' && quote != '\'') return text.find_first_of(" \t\r\n,]}#", begin);
  const std::string thrice(3, quote);
  if (text.compare(begin, 3, thrice) == 0) return text.find(thrice, begin + 3) + 3;
  std::size_t at = begin + 1;
  while (text[at] != quote) at += quote == '"' && text[at] == '\\' ? 2 : 1;
  return at + 1;
}

std::string replaced(const std::string& text, const toml::node* node, const std::string& what,
                     const std::string& expression) {
  if (node == nullptr || !(node->is_string() || node->is_number()))
    throw InputError("", 0, what, "an expression of the model file", what);
  const std::size_t begin = offset_of(text, node->source().begin);
  const std::size_t end = std::min(end_of_value(text, begin), text.size());
  return text.substr(0, begin) + written(std::string_view(expression)) + text.substr(end);
}

}  // namespace

std::string with_entry(const std::string& text, int i, int j, const std::string& expression) {
  const toml::table model = document(text);
  const std::string what = "the entry " + std::to_string(i) + " " + std::to_string(j);
  const toml::node* node = nullptr;
  if (i >= 1 && j >= 1)
    node = model["matrix"]["rows"][static_cast<std::size_t>(i) - 1][static_cast<std::size_t>(j) - 1]
               .node();
  return replaced(text, node, what, expression);
}

std::string with_let(const std::string& text, const std::string& name,
                     const std::string& expression) {
  const toml::table model = document(text);
  return replaced(text, model["let"][name].node(), "the sub-expression " + in_quotes(name),
                  expression);
}

std::vector<std::string> let_names(const std::string& text) {
  const toml::table model = document(text);
  std::vector<std::string> names;
  if (const toml::table* let = model["let"].as_table())
    for (const auto& [key, node] : *let) names.emplace_back(key.str());
  return names;
}

}  // namespace regulus::codegen
