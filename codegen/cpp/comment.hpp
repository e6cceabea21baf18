// SPDX-License-Identifier: GPL-3.0-or-later
// Comments of generated code. Their texts may come from a model file, which is untrusted.
#pragma once

#include <string>
#include <string_view>

namespace regulus::inline cpp {

/// The text as it may stand behind "//" on one line: control characters, backslashes (a line may
/// not be continued), invalid UTF-8 and characters that reorder or hide text become "?", and
/// comment marks are pulled apart.
[[nodiscard]] std::string comment_text(std::string_view text);

/// The text, made safe by comment_text, as "//" lines of at most 100 columns where words allow.
[[nodiscard]] std::string comment_lines(std::string_view indent, std::string_view text);

/// A line "// Label     text", wrapped under the text's first column.
[[nodiscard]] std::string labelled_comment(std::string_view label, std::string_view text);

}  // namespace regulus::inline cpp
