// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace regulus::detail {

/// Returns the words of a line. Blanks separate words, quotes of either kind enclose a word, #
/// begins a comment. Throws UsageError for a quote that is not closed.
[[nodiscard]] std::vector<std::string> split_words(std::string_view line);

/// Returns the words from that number on, with single blanks: the expression at the end of a line.
[[nodiscard]] std::string rest_of(const std::vector<std::string>& words, std::size_t from);

}  // namespace regulus::detail
