// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace regulus::inline shell {

/// The words of a line: blanks separate, quotes of either kind hold together, # begins a comment.
/// Throws UsageError for a quote that is not closed.
[[nodiscard]] std::vector<std::string> split_words(std::string_view line);

/// From the word of that number on, with single blanks: the expression that ends a line.
[[nodiscard]] std::string rest_of(const std::vector<std::string>& words, std::size_t from);

}  // namespace regulus::inline shell
