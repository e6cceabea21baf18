// SPDX-License-Identifier: GPL-3.0-or-later
// Text for a terminal, broken at blanks.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace regulus::detail {

/// Returns the lines of the text with at most so many characters, where blanks allow it. The text begins
/// in the column `indent`, and so does each new line. Lines that begin with a blank are laid out by
/// hand and stay.
[[nodiscard]] std::string wrapped(std::string_view text, std::size_t columns, std::size_t indent);

/// Returns the lines of a report in the same way. Labels stay alone in their column.
[[nodiscard]] std::string wrapped_report(std::string_view report, std::size_t columns);

/// The same for a help text: a line goes on below its second column, which two blanks begin.
[[nodiscard]] std::string wrapped_table(std::string_view text, std::size_t columns);

}  // namespace regulus::detail
