// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/search_words.hpp"

#include <algorithm>

#include "regulus/codegen/driver/ingredients.hpp"
#include "regulus/codegen/model/errors.hpp"
#include "regulus/codegen/model/names.hpp"
#include "regulus/codegen/model/request.hpp"

namespace regulus::codegen {
namespace {

template <class Value>
struct Word {
  const char* word;
  Value value;
};

constexpr Word<Determinant> kDeterminants[] = {{"both", Determinant::kBoth},
                                               {"expansion", Determinant::kExpansion},
                                               {"gauss", Determinant::kElimination}};
constexpr Word<Bisection> kBisections[] = {{"impact", Bisection::kImpact},
                                           {"widest", Bisection::kWidest},
                                           {"weighted", Bisection::kWeighted}};
constexpr Word<Uncertainty> kUncertainties[] = {{"elements", Uncertainty::kElements},
                                                {"variables", Uncertainty::kVariables}};
constexpr Word<std::optional<Entries>> kEntries[] = {
    {"auto", std::nullopt}, {"natural", Entries::kNatural}, {"derivatives", Entries::kDerivatives}};

[[noreturn]] void refuse(const char* option, std::string_view word,
                         const std::vector<std::string>& words) {
  const std::string meant = nearest(word, words);
  throw UsageError(std::string(option) + ": there is no " + in_quotes(word) +
                   (meant.empty() ? "" : "; did you mean " + in_quotes(meant) + "?") +
                   " It can be " + alternatives(words));
}

template <class Table>
auto value_in(const Table& table, const char* option, std::string_view word) {
  std::vector<std::string> words;
  for (const auto& entry : table) {
    if (word == entry.word) return entry.value;
    words.emplace_back(entry.word);
  }
  refuse(option, word, words);
}

template <class Table, class Value>
std::string word_in(const Table& table, const Value& value) {
  for (const auto& entry : table)
    if (entry.value == value) return entry.word;
  throw UsageError("an option has a value that is none of its enumeration");
}

}  // namespace

Method method_of(std::string_view word) {
  if (const auto method = parse_method(word)) return *method;
  std::vector<std::string> words;
  for (int i = 0; i <= static_cast<int>(Method::kClosedForm); ++i)
    words.emplace_back(name(static_cast<Method>(i)));
  refuse("--method", word, words);
}

Determinant determinant_of(std::string_view word) {
  return value_in(kDeterminants, "--determinant", word);
}
Bisection bisection_of(std::string_view word) { return value_in(kBisections, "--bisect", word); }
Uncertainty uncertainty_of(std::string_view word) {
  return value_in(kUncertainties, "--uncertainty", word);
}
std::optional<Entries> entries_of(std::string_view word) {
  return value_in(kEntries, "--entries", word);
}

std::optional<Isa> isa_of(std::string_view word) {
  if (word.empty()) return std::nullopt;
  if (const auto isa = parse_isa(word)) return isa;
  std::vector<std::string> words;
  for (const Isa isa : kAllIsas) words.emplace_back(name(isa));
  refuse("--isa", word, words);
}

void require_ingredients(const std::vector<std::string>& names) {
  const std::vector<std::string> known = ingredient_names();
  for (const std::string& name : names)
    if (std::ranges::find(known, name) == known.end()) refuse("--without", name, known);
}

std::string word_of(Determinant value) { return word_in(kDeterminants, value); }
std::string word_of(Bisection value) { return word_in(kBisections, value); }
std::string word_of(Uncertainty value) { return word_in(kUncertainties, value); }
std::string word_of(std::optional<Entries> value) { return word_in(kEntries, value); }
std::string word_of(std::optional<Isa> value) {
  return value ? std::string(name(*value)) : std::string();
}

}  // namespace regulus::codegen
