// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/facts.hpp"

#include <algorithm>
#include <iterator>

#include "codegen/answer/keys.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

/// The column in which sentences begin.
constexpr std::size_t kMargin = 11;

/// Returns the label and the blanks up to its sentence.
std::string padded(const std::string& label) {
  if (label.ends_with(':') || label.size() + 1 >= kMargin) return label + ' ';
  return label + std::string(kMargin - label.size(), ' ');
}

void add_lines(std::string& text, const Fact& fact) {
  text += padded(fact.label);
  for (const char c : fact.sentence) {
    text += c;
    if (c == '\n') text.append(kMargin, ' ');
  }
  text += '\n';
}

/// A result that is 0 has no sign for who reads it.
void remove_signs_of_zeros(Json& value) {
  if (value.is_number_float() && value.get<double>() == 0) value = 0.0;
  if (value.is_structured())
    for (Json& part : value) remove_signs_of_zeros(part);
}

}  // namespace

Facts& Facts::tell(std::string key, Json value, std::string label, std::string sentence) {
  add(std::move(key), std::move(value));
  return say(std::move(label), std::move(sentence));
}

Facts& Facts::add(std::string key, Json value) {
  if (!are_for_programs()) return *this;
  remove_signs_of_zeros(value);
  facts_.push_back({std::move(key), std::move(value), "", ""});
  return *this;
}

Facts& Facts::say(std::string label, std::string sentence) {
  if (are_for_people() && !sentence.empty())
    facts_.push_back({"", nullptr, std::move(label), std::move(sentence)});
  return *this;
}

Facts& Facts::say_lines(std::string_view lines) {
  while (!lines.empty()) {
    const std::string_view line = lines.substr(0, lines.find('\n'));
    lines.remove_prefix(std::min(line.size() + 1, lines.size()));
    const std::string_view label = line.substr(0, line.find(' '));
    const std::size_t begin = label.empty() ? kMargin : line.find_first_not_of(' ', label.size());
    if (begin < line.size()) say(std::string(label), std::string(line.substr(begin)));
  }
  return *this;
}

Facts& Facts::tell_part(std::string key, Facts part) {
  add(std::move(key), part.object());
  for (Fact& fact : part.facts_) say(std::move(fact.label), std::move(fact.sentence));
  return *this;
}

Facts& Facts::append(Facts others) {
  facts_.insert(facts_.end(), std::make_move_iterator(others.facts_.begin()),
                std::make_move_iterator(others.facts_.end()));
  return *this;
}

std::string Facts::text() const {
  std::string text;
  for (const Fact& fact : facts_)
    if (!fact.sentence.empty()) add_lines(text, fact);
  return text;
}

Json Facts::object() const {
  Json object = Json::object();
  for (const Fact& fact : facts_)
    if (!fact.key.empty()) object[fact.key] = fact.value;
  return object;
}

Json Facts::report() const {
  Json report = Json::object();
  for (const Key& key : head_keys()) report[std::string(key.name)] = nullptr;
  report.update(object());
  if (report["proof"].is_null())
    report["proof"] = Json::array({{{"file", nullptr}, {"reason", kNoProofAsked}}});
  return report;
}

}  // namespace regulus::detail
