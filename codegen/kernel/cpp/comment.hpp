// SPDX-License-Identifier: GPL-3.0-or-later
// Comments of generated code. Their texts may come from a model file, which is untrusted.
#pragma once

#include <string>
#include <string_view>

namespace regulus::detail {

/// Returns the text in a form that is safe after "//" on one line. Control characters, backslashes
/// (which would continue the line), invalid UTF-8 and characters that reorder or hide text become
/// "?"; comment marks are separated by a space.
[[nodiscard]] std::string comment_text(std::string_view text);

/// Returns the text, made safe by comment_text, as "//" lines of at most 100 columns if the words
/// allow.
[[nodiscard]] std::string comment_lines(std::string_view indent, std::string_view text);

/// Returns a line "// Label text", wrapped under the text's first column.
[[nodiscard]] std::string labelled_comment(std::string_view label, std::string_view text);

}  // namespace regulus::detail
