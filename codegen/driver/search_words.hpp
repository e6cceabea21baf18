// SPDX-License-Identifier: GPL-3.0-or-later
// The words of the search's options and what they mean: read once, in one place.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "regulus/kernel/isa.hpp"
#include "regulus/search/problem.hpp"

namespace regulus::codegen {

// Each throws UsageError for a word that it does not know, with the one that was probably meant.
[[nodiscard]] Method method_of(std::string_view word);
[[nodiscard]] Determinant determinant_of(std::string_view word);
[[nodiscard]] Bisection bisection_of(std::string_view word);
[[nodiscard]] Uncertainty uncertainty_of(std::string_view word);
/// nullopt: "auto".
[[nodiscard]] std::optional<Entries> entries_of(std::string_view word);
/// nullopt: the empty word, the best that this processor has.
[[nodiscard]] std::optional<Isa> isa_of(std::string_view word);
void require_ingredients(const std::vector<std::string>& names);

[[nodiscard]] std::string word_of(Determinant value);
[[nodiscard]] std::string word_of(Bisection value);
[[nodiscard]] std::string word_of(Uncertainty value);
[[nodiscard]] std::string word_of(std::optional<Entries> value);
[[nodiscard]] std::string word_of(std::optional<Isa> value);

}  // namespace regulus::codegen
