// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/schema.hpp"

#include <nlohmann/json.hpp>

#include "codegen/answer/keys.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

constexpr Key kErrorKeys[] = {
    {"kind", "usage|input|file|internal"},
    {"message", "text"},
    {"exit", "count", "the exit code"},
    {"file?", "text"},
    {"line?", "count", "of the file; 0: none"},
    {"problem?", "text"},
    {"remedy?", "text"},
    {"symbol?", "text"},
};

/// Removes an ending; false if there is none.
bool take(std::string_view& text, std::string_view ending) {
  if (!text.ends_with(ending)) return false;
  text.remove_suffix(ending.size());
  return true;
}

Json words_of(std::string_view type) {
  Json words = Json::array();
  while (!type.empty()) {
    const std::string_view word = type.substr(0, type.find('|'));
    words.push_back(word);
    type.remove_prefix(std::min(word.size() + 1, type.size()));
  }
  return words;
}

Json schema_of(std::string_view type) {
  if (take(type, "?")) return {{"anyOf", {{{"type", "null"}}, schema_of(type)}}};
  if (take(type, "[]")) return {{"type", "array"}, {"items", schema_of(type)}};
  if (take(type, "{}")) return {{"type", "object"}, {"additionalProperties", schema_of(type)}};
  if (type.find('|') != type.npos) return {{"enum", words_of(type)}};
  if (type == "text") return {{"type", "string"}};
  if (type == "flag") return {{"type", "boolean"}};
  if (type == "count") return {{"type", "integer"}, {"minimum", 0}};
  return {{"$ref", "#/$defs/" + std::string(type)}};
}

void add_keys(std::span<const Key> keys, Json& properties, Json& required) {
  for (const Key& key : keys) {
    std::string_view name = key.name;
    if (!take(name, "?")) required.push_back(name);
    Json schema = schema_of(key.type);
    if (!key.meaning.empty()) schema["description"] = key.meaning;
    properties[std::string(name)] = std::move(schema);
  }
}

Json object_schema(const ObjectKind& kind, bool is_report) {
  Json properties = Json::object(), required = Json::array();
  if (is_report) add_keys(head_keys(), properties, required);
  for (const std::span<const Key> keys : kind.keys) add_keys(keys, properties, required);
  if (is_report) properties["verdict"] = {{"enum", words_of(kind.verdicts)}};
  return {{"type", "object"},
          {"description", kind.meaning},
          {"properties", std::move(properties)},
          {"required", std::move(required)},
          {"additionalProperties", false}};
}

/// Returns the schemas of values that are not objects.
Json value_schemas() {
  return {
      {"exact",
       {{"type", "string"},
        {"minLength", 1},
        {"description", "an exact constant, as model files and options take it"}}},
      {"enclosure",
       {{"type", "array"},
        {"items", {{"type", {"number", "null"}}}},
        {"minItems", 2},
        {"maxItems", 2},
        {"description", "[lower, upper], rounded outward; an infinite end is null"}}},
      {"range",
       {{"type", "array"},
        {"items", {{"type", "number"}}},
        {"minItems", 2},
        {"maxItems", 2},
        {"description", "[lower, upper], rounded outward"}}},
      {"rounded", {{"type", "number"}, {"description", "rounded to the side that claims less"}}},
      {"approx", {{"type", "number"}, {"description", "without a claim"}}},
      {"sha256", {{"type", "string"}, {"pattern", "^[0-9a-f]{64}$"}}}};
}

Json error_schema() {
  const ObjectKind kind{"error", "what prevented a report", {kErrorKeys}};
  return {{"type", "object"},
          {"properties", {{"error", object_schema(kind, false)}}},
          {"required", {"error"}},
          {"additionalProperties", false}};
}

/// Returns "LostTwist" for "lost_twist".
std::string type_name(std::string_view name) {
  std::string result;
  bool is_first = true;
  for (const char c : name) {
    if (c != '_') result += is_first && c >= 'a' ? static_cast<char>(c - 'a' + 'A') : c;
    is_first = c == '_';
  }
  return result;
}

/// Returns the words of a type, as text literals.
std::string quoted_words(std::string_view type, const char* separator) {
  std::string text;
  for (const Json& word : words_of(type)) text += (text.empty() ? "" : separator) + word.dump();
  return text;
}

std::string type_of(std::string_view type) {
  if (take(type, "?")) return type_of(type) + " | null";
  if (take(type, "[]")) return "readonly (" + type_of(type) + ")[]";
  if (take(type, "{}")) return "Record<string, " + type_of(type) + ">";
  if (type.find('|') != type.npos) return quoted_words(type, " | ");
  if (type == "text" || type == "exact" || type == "sha256") return "string";
  if (type == "flag") return "boolean";
  if (type == "count" || type == "rounded" || type == "approx") return "number";
  if (type == "range") return "Enclosure";
  return type_name(type);
}

std::string interface_of(const ObjectKind& kind, bool is_report) {
  std::string text = "/** " + std::string(kind.meaning) + " */\nexport interface " +
                     type_name(kind.name) + (is_report ? " extends Head" : "") + " {\n";
  if (!kind.verdicts.empty()) text += "  readonly verdict: " + type_of(kind.verdicts) + ";\n";
  for (const std::span<const Key> keys : kind.keys)
    for (const Key& key : keys)
      text += "  readonly " + std::string(key.name) + ": " + type_of(key.type) + ";" +
              (key.meaning.empty() ? "" : " // " + std::string(key.meaning)) + "\n";
  return text + "}\n\n";
}

std::string python_type(std::string_view type) {
  if (take(type, "?")) return "Optional[" + python_type(type) + "]";
  if (take(type, "[]")) return "list[" + python_type(type) + "]";
  if (take(type, "{}")) return "dict[str, " + python_type(type) + "]";
  if (type.find('|') != type.npos) return "Literal[" + quoted_words(type, ", ") + "]";
  if (type == "text" || type == "exact" || type == "sha256") return "str";
  if (type == "flag") return "bool";
  if (type == "count") return "int";
  if (type == "rounded" || type == "approx") return "float";
  return type_name(type);
}

/// Returns the lines of the keys that may be missing, or of the others.
std::string python_keys(const ObjectKind& kind, bool may_be_missing) {
  std::string text;
  if (!kind.verdicts.empty() && !may_be_missing)
    text += "    verdict: " + python_type(kind.verdicts) + "\n";
  for (const std::span<const Key> keys : kind.keys)
    for (const Key& key : keys) {
      std::string_view name = key.name;
      if (take(name, "?") != may_be_missing) continue;
      text += "    " + std::string(name) + ": " + python_type(key.type) +
              (key.meaning.empty() ? "" : "  # " + std::string(key.meaning)) + "\n";
    }
  return text;
}

/// Returns a TypedDict, with a base for the keys that are always there: Python 3.9 has no
/// NotRequired.
std::string python_class(const ObjectKind& kind, const std::string& name, std::string base) {
  const std::string always = python_keys(kind, false), sometimes = python_keys(kind, true);
  const std::string words = "    \"\"\"" + std::string(kind.meaning) + "\"\"\"\n\n";
  std::string text;
  if (!always.empty() && !sometimes.empty()) {
    text = "class _" + name + "(" + base + "):\n" + always + "\n\n";
    base = "_" + name;
  }
  const std::string total = sometimes.empty() ? "" : ", total=False";
  return text + "class " + name + "(" + base + total + "):\n" + words +
         (sometimes.empty() ? always : sometimes) + "\n\n";
}

}  // namespace

Json json_schema() {
  Json definitions = value_schemas(), reports = Json::array();
  for (const ObjectKind& kind : report_kinds()) {
    definitions[std::string(kind.name)] = object_schema(kind, true);
    reports.push_back({{"$ref", "#/$defs/" + std::string(kind.name)}});
  }
  for (const ObjectKind& kind : object_kinds())
    definitions[std::string(kind.name)] = object_schema(kind, false);
  definitions["error"] = error_schema();
  reports.push_back({{"$ref", "#/$defs/error"}});
  return {
      {"$schema", "https://json-schema.org/draft/2020-12/schema"},
      {"$id", "https://regulus.invalid/schema/report.schema.json"},
      {"title", "Reports of regulus --json"},
      {"description",
       "The report of a question, or the error that prevented it; `$defs` has a schema for each "
       "kind. The first keys are the same in all reports."},
      {"anyOf", std::move(reports)},
      {"$defs", std::move(definitions)}};
}

std::string typescript_types() {
  std::string text =
      "// SPDX-License-Identifier: GPL-3.0-or-later\n"
      "// The JSON reports, from the table of keys (codegen/answer/keys.hpp).\n\n"
      "export type Enclosure = readonly [number | null, number | null];\n\n";
  text += interface_of({"head", "What every report begins with.", {head_keys()}}, false);
  for (const ObjectKind& kind : report_kinds()) text += interface_of(kind, true);
  for (const ObjectKind& kind : object_kinds()) text += interface_of(kind, false);
  return text;
}

std::string python_types() {
  std::string text =
      "# SPDX-License-Identifier: GPL-3.0-or-later\n"
      "\"\"\"The JSON reports, as `json` of a result has them: null is None.\"\"\"\n\n"
      "from __future__ import annotations\n\n"
      "from typing import List, Literal, Optional, TypedDict, Union\n\n"
      "Range = List[float]\n"
      "\"\"\"[lower, upper], rounded outward.\"\"\"\n\n"
      "Enclosure = List[Optional[float]]\n"
      "\"\"\"[lower, upper], rounded outward; an infinite end is None.\"\"\"\n\n\n";
  std::vector<Key> same;
  for (const Key& key : head_keys())
    if (key.name != "verdict") same.push_back(key);  // each report has its own words
  text += python_class({"", "What every report begins with.", {same}}, "Head", "TypedDict");
  for (const ObjectKind& kind : object_kinds())
    text += python_class(kind, type_name(kind.name), "TypedDict");
  std::string names;
  for (const ObjectKind& kind : report_kinds()) {
    const std::string name = type_name(kind.name) + "Report";
    text += python_class(kind, name, "Head");
    names += (names.empty() ? "" : ", ") + name;
  }
  return text + "Report = Union[" + names + "]\n";
}

}  // namespace regulus::detail
