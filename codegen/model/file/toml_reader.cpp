// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/file/toml_reader.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "codegen/model/exact/decimal.hpp"
#include "codegen/model/file/declarations.hpp"
#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

int line_of(const toml::source_region& source) { return static_cast<int>(source.begin.line); }

std::string join(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

std::string describe(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array of " + std::to_string(node.as_array()->size());
    case toml::node_type::string:
      return "the string " + in_quotes(node.as_string()->get());
    case toml::node_type::integer:
      return "the integer " + std::to_string(node.as_integer()->get());
    case toml::node_type::floating_point: {
      const double value = node.as_floating_point()->get();
      return std::isnan(value) ? "nan" : std::isinf(value) ? "an infinite number" : "a number";
    }
    case toml::node_type::boolean:
      return "a boolean";
    default:
      return "a date or time";
  }
}

/// True if a number cannot end before, or begin after, this character.
bool continues_number(char c) {
  return std::string_view("0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_.+-")
             .find(c) != std::string_view::npos;
}

/// True if the library read the same number: its value is the exact one, or the double nearest to
/// it. So two readers that share no code agree about the place and the value of the number.
bool is_reading_of(const GiNaC::numeric& exact, const toml::node& node) {
  if (const auto* integer = node.as_integer()) return exact == exact_integer(integer->get());
  return rounds_to(exact, node.as_floating_point()->get());
}

}  // namespace

std::vector<TomlEntry> TomlReader::entries(const TomlEntry& entry) const {
  struct Positioned {
    toml::source_position position;
    TomlEntry entry;
  };
  std::vector<Positioned> found;
  for (const auto& [key, node] : table_of(entry)) {
    const std::string name(key.str());
    if (!is_name(name))
      throw InputError(
          file_, line_of(key.source()),
          "the key " + in_quotes(name) + (entry.path.empty() ? "" : " in " + entry.path),
          "a letter, then letters, digits and underscores, at most 64 in all", name);
    found.push_back(
        {key.source().begin, {name, join(entry.path, name), &node, line_of(key.source())}});
  }
  std::ranges::sort(found, {}, [](const Positioned& p) {
    return std::tuple(p.position.line, p.position.column);
  });
  std::vector<TomlEntry> result;
  for (Positioned& p : found) result.push_back(std::move(p.entry));
  return result;
}

std::vector<TomlEntry> TomlReader::entries(const TomlEntry& table,
                                           std::span<const std::string> known) const {
  std::vector<TomlEntry> result = entries(table);
  for (const TomlEntry& entry : result) {
    if (std::ranges::find(known, entry.key) != known.end()) continue;
    throw InputError::statement(
        file_, entry.line, "unknown key " + in_quotes(entry.path),
        suggestion(entry.key, known, "the keys here are: " + enumeration(known)), entry.key);
  }
  return result;
}

TomlEntry TomlReader::optional(const TomlEntry& table, const std::string& key) const {
  const toml::node* node = table_of(table).get(key);
  return {key, join(table.path, key), node, node ? line_of(node->source()) : table.line};
}

TomlEntry TomlReader::required(const TomlEntry& table, const std::string& key) const {
  TomlEntry entry = optional(table, key);
  if (entry.node) return entry;
  throw InputError::statement(
      file_, table.line,
      "there is no " + in_quotes(key) + (table.path.empty() ? "" : " in " + table.path),
      "add " + in_quotes(entry.path), key);
}

std::vector<TomlEntry> TomlReader::elements(const TomlEntry& entry,
                                            const std::string& expected) const {
  const toml::array* array = entry.node->as_array();
  if (!array) refuse(entry, expected);
  std::vector<TomlEntry> result;
  for (const toml::node& node : *array)
    result.push_back({entry.key, entry.path + "[" + std::to_string(result.size() + 1) + "]", &node,
                      line_of(node.source())});
  return result;
}

std::string TomlReader::text(const TomlEntry& entry, const std::string& expected) const {
  const auto* text = entry.node->as_string();
  if (!text) refuse(entry, expected);
  return text->get();
}

std::string TomlReader::label(const TomlEntry& entry) const {
  const std::string expected = "a string of at most 200 bytes without control characters or \\";
  std::string result = text(entry, expected);
  if (!is_label(result)) refuse(entry, expected);
  return result;
}

std::string TomlReader::name(const TomlEntry& entry) const {
  std::string result = text(entry, "a name in a string");
  require_free_name(result, place(entry));
  return result;
}

ParsedExpression TomlReader::expression(const TomlEntry& entry, Names& names,
                                        NumberUnit unit) const {
  if (const auto* text = entry.node->as_string())
    return parse_expression(text->get(), names, place(entry), 0, unit);
  return number_of(entry);
}

ParsedExpression TomlReader::constant(const TomlEntry& entry, NumberUnit unit) const {
  if (const auto* text = entry.node->as_string())
    return parse_constant(text->get(), place(entry), unit);
  return number_of(entry);
}

ParsedExpression TomlReader::number_of(const TomlEntry& entry) const {
  const toml::node& node = *entry.node;
  const auto* real = node.as_floating_point();
  if (!node.is_number() || (real && !std::isfinite(real->get())))
    refuse(entry, "a finite number, or an expression in a string");
  const std::string_view literal = literal_of(entry);
  const std::optional<GiNaC::numeric> exact = exact_toml_number(literal);
  if (!exact)
    refuse(entry, "the number " + in_quotes(literal) + " for " + entry.path, kNumberLimits);
  if (!is_reading_of(*exact, node))
    throw InternalError(file_ + ":" + std::to_string(entry.line) + ": " + entry.path + " reads " +
                        in_quotes(literal) +
                        ", which is not the number that the TOML library read");
  return number(*exact);
}

/// Returns the characters of the file that a number was parsed from.
std::string_view TomlReader::literal_of(const TomlEntry& entry) const {
  const auto [begin, end, path] = entry.node->source();
  const std::size_t from = source_.offset(begin.line, begin.column);
  const std::size_t to = source_.offset(end.line, end.column);
  const std::string_view text = source_.text();
  if (from >= to || begin.line != end.line || (from > 0 && continues_number(text[from - 1])) ||
      (to < text.size() && continues_number(text[to])))
    throw InternalError(file_ + ":" + std::to_string(entry.line) + ": the number " + entry.path +
                        " is not where the TOML library found it");
  return text.substr(from, to - from);
}

Place TomlReader::place(const TomlEntry& entry) const { return {file_, entry.line, entry.path}; }

void TomlReader::refuse(const TomlEntry& entry, const std::string& found,
                        const std::string& expected) const {
  throw InputError(file_, entry.line, found, expected, entry.path);
}

void TomlReader::reject(const TomlEntry& entry, const std::string& problem,
                        const std::string& remedy) const {
  throw InputError::statement(file_, entry.line, problem, remedy, entry.path);
}

void TomlReader::refuse(const TomlEntry& entry, const std::string& expected) const {
  refuse(entry, describe(*entry.node) + " for " + entry.path, expected);
}

const toml::table& TomlReader::table_of(const TomlEntry& entry) const {
  const toml::table* table = entry.node->as_table();
  if (!table) refuse(entry, "a table");
  return *table;
}

}  // namespace regulus::detail
