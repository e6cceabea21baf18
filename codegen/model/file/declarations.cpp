// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/file/declarations.hpp"

#include <algorithm>
#include <utility>

#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {

void require_free_name(const std::string& name, const Place& place) {
  const std::string found = "the name " + in_quotes(name) + " for " + place.key;
  if (!is_name(name))
    throw InputError(place.file, place.line, found,
                     "a letter, then letters, digits and underscores, at most 64 in all", name);
  if (is_reserved(name))
    throw InputError::statement(place.file, place.line,
                                "the name " + in_quotes(name) + " is reserved",
                                "choose another name", name);
}

void Declarations::declare(const std::string& name, ParsedExpression meaning, const Place& place) {
  insert(name, {.meaning = std::move(meaning), .place = place});
}

void Declarations::declare_expression(const std::string& name, std::string text,
                                      const Place& place) {
  insert(name, {.state = State::kUnread, .text = std::move(text), .place = place});
}

void Declarations::insert(const std::string& name, Declaration declaration) {
  const Place place = declaration.place;
  require_free_name(name, place);
  const auto [at, inserted] = declarations_.emplace(name, std::move(declaration));
  if (inserted) return;
  const Place& first = at->second.place;
  throw InputError::statement(
      place.file, place.line,
      in_quotes(name) + " is declared twice, as " + first.key +
          (first.line > 0 ? " (line " + std::to_string(first.line) + ")" : "") + " and as " +
          place.key,
      "choose another name for one of them", name);
}

const ParsedExpression* Declarations::find(const std::string& name, int depth) {
  const auto at = declarations_.find(name);
  if (at == declarations_.end()) return nullptr;
  Declaration& declaration = at->second;
  if (declaration.state == State::kBeingRead) refuse_cycle(name);
  if (declaration.state == State::kUnread) {
    declaration.state = State::kBeingRead;
    being_read_.push_back(name);
    declaration.meaning = parse_expression(declaration.text, *this, declaration.place, depth);
    being_read_.pop_back();
    declaration.state = State::kRead;
  }
  return &declaration.meaning;
}

std::vector<std::string> Declarations::all() const {
  std::vector<std::string> names;
  for (const auto& [name, declaration] : declarations_) names.push_back(name);
  return names;
}

void Declarations::refuse_cycle(const std::string& name) const {
  const auto begin = std::ranges::find(being_read_, name);
  std::string cycle;
  for (auto it = begin; it != being_read_.end(); ++it) cycle += *it + " -> ";
  const Place& place = declarations_.at(name).place;
  throw InputError::statement(place.file, place.line,
                              "these names are declared in a cycle: " + cycle + name,
                              "a sub-expression must not use itself", name);
}

}  // namespace regulus::detail
