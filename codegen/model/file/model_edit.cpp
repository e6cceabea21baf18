// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/file/model_edit.hpp"

#include <toml++/toml.h>

#include <algorithm>

#include "codegen/model/file/source_lines.hpp"
#include "codegen/model/file/toml_limits.hpp"
#include "codegen/model/file/written.hpp"
#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"

namespace regulus {
namespace {

toml::table document(const std::string& text) try {
  require_toml_limits(text, "");
  return toml::parse(text);
} catch (const toml::parse_error& error) {
  throw InputError("", static_cast<int>(error.source().begin.line), "text that is not TOML",
                   "TOML 1.0");
}

std::string replaced(const std::string& text, const toml::node* node, const std::string& what,
                     const std::string& expression) {
  if (node == nullptr || !(node->is_string() || node->is_number()))
    throw InputError::statement("", 0, "the model file has no expression for " + what,
                                "edit changes the whole text", what);
  const auto [begin, end, path] = node->source();
  const SourceLines lines(text);
  return text.substr(0, lines.offset(begin.line, begin.column)) +
         written(std::string_view(expression)) + text.substr(lines.offset(end.line, end.column));
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

}  // namespace regulus
