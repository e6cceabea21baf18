// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/choices.hpp"

#include <algorithm>

#include "codegen/model/names.hpp"
#include "codegen/question/engine/ingredients.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

constexpr Choice<Determinant> kDeterminants[] = {{"expansion", Determinant::kExpansion},
                                                 {"gauss", Determinant::kElimination},
                                                 {"both", Determinant::kBoth}};
constexpr Choice<std::optional<Entries>> kEntries[] = {
    {"auto", std::nullopt}, {"natural", Entries::kNatural}, {"derivatives", Entries::kDerivatives}};
constexpr Choice<Bisection> kBisections[] = {{"widest", Bisection::kWidest},
                                             {"weighted", Bisection::kWeighted},
                                             {"impact", Bisection::kImpact}};
constexpr Choice<Uncertainty> kUncertainties[] = {{"elements", Uncertainty::kElements},
                                                  {"variables", Uncertainty::kVariables}};
constexpr Choice<Engine> kEngines[] = {{"auto", Engine::kAuto},
                                       {"jit", Engine::kJit},
                                       {"clang", Engine::kClang},
                                       {"interpreted", Engine::kInterpreted}};

[[noreturn]] void refuse(const char* option, std::string_view word,
                         const std::vector<std::string>& words) {
  const std::string meant = nearest(word, words);
  throw UsageError(
      std::string(option) + ": there is no " + in_quotes(word) +
      (meant.empty() ? "; it can be " : "; did you mean " + in_quotes(meant) + "? It can be ") +
      alternatives(words));
}

template <class Value>
void require_known(const char* option, const Value& value) {
  if (word_of(value).empty())
    throw UsageError(std::string(option) + ": invalid value; valid values are " +
                     alternatives(words_of<Value>()));
}

}  // namespace

template <>
std::span<const Choice<Determinant>> choices() {
  return kDeterminants;
}
template <>
std::span<const Choice<std::optional<Entries>>> choices() {
  return kEntries;
}
template <>
std::span<const Choice<Bisection>> choices() {
  return kBisections;
}
template <>
std::span<const Choice<Uncertainty>> choices() {
  return kUncertainties;
}
template <>
std::span<const Choice<Engine>> choices() {
  return kEngines;
}
template <>
std::span<const Choice<Method>> choices() {
  static const std::vector<Choice<Method>> methods = [] {
    std::vector<Choice<Method>> all;
    for (int i = 0; i <= static_cast<int>(Method::kClosedForm); ++i) {
      const auto method = static_cast<Method>(i);
      all.push_back({name(method), method});
    }
    return all;
  }();
  return methods;
}
template <>
std::span<const Choice<std::optional<Isa>>> choices() {
  static const std::vector<Choice<std::optional<Isa>>> sets = [] {
    std::vector<Choice<std::optional<Isa>>> all;
    for (const Isa isa : kAllIsas) all.push_back({name(isa), isa});
    return all;
  }();
  return sets;
}

template <class Value>
Value choice_of(const char* option, std::string_view word) {
  for (const Choice<Value>& choice : choices<Value>())
    if (word == choice.word) return choice.value;
  refuse(option, word, words_of<Value>());
}

template Method choice_of(const char*, std::string_view);
template Determinant choice_of(const char*, std::string_view);
template std::optional<Entries> choice_of(const char*, std::string_view);
template Bisection choice_of(const char*, std::string_view);
template Uncertainty choice_of(const char*, std::string_view);
template Engine choice_of(const char*, std::string_view);
template std::optional<Isa> choice_of(const char*, std::string_view);

void require_valid(const SearchOptions& options) {
  require_known("--method", options.method);
  require_known("--determinant", options.determinant);
  require_known("--entries", options.entries);
  require_known("--bisect", options.bisection);
  require_known("--uncertainty", options.uncertainty);
  require_known("--engine", options.engine);
  if (options.isa) require_known("--isa", options.isa);
  const std::vector<std::string> known = ingredient_names();
  for (const std::string& name : options.without)
    if (std::ranges::find(known, name) == known.end()) refuse("--without", name, known);
}

}  // namespace regulus::detail
