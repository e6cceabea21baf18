// SPDX-License-Identifier: GPL-3.0-or-later
// The words of the search's options and their values. The command line, the shell, the manual,
// completion and the reports all use them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "codegen/question/engine/options.hpp"
#include "runtime/kernel/isa.hpp"
#include "runtime/problem/problem.hpp"

namespace regulus::detail {

template <class Value>
struct Choice {
  std::string_view word;
  Value value;
};

/// Every choice of an option, in the order of --help. Defined for Method, Determinant, optional
/// Entries (nullopt is "auto"), Bisection, Uncertainty, Engine and optional Isa; for Isa, nullopt
/// has no word.
template <class Value>
[[nodiscard]] std::span<const Choice<Value>> choices();

/// Returns the value of a word. Throws UsageError for an unknown word, with a suggestion. The
/// message names `option`: "--method".
template <class Value>
[[nodiscard]] Value choice_of(const char* option, std::string_view word);

/// Returns the word of a value; empty if it has none.
template <class Value>
[[nodiscard]] std::string word_of(const Value& value) {
  for (const Choice<Value>& choice : choices<Value>())
    if (choice.value == value) return std::string(choice.word);
  return {};
}

template <class Value>
[[nodiscard]] std::vector<std::string> words_of() {
  std::vector<std::string> words;
  for (const Choice<Value>& choice : choices<Value>()) words.emplace_back(choice.word);
  return words;
}

/// Throws    UsageError if a value is not in its enumeration (a program can make one by a cast), or
///           if --help does not list the name of an ingredient.
void require_valid(const SearchOptions& options);

}  // namespace regulus::detail
