// SPDX-License-Identifier: GPL-3.0-or-later
// What may be called what: the names of a model file, and how an unknown one is reported.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace regulus::inline model {

/// Whether the text matches [A-Za-z][A-Za-z0-9_]* (ASCII) and has at most 64 characters. Words of
/// C++ are names like others: a name reaches generated code only through a mangling.
[[nodiscard]] bool is_name(std::string_view text) noexcept;

/// Whether the name is taken by the language of model files: pi, deg, a function, or an entry of
/// the preconditioner (k_1_1, k_1_2 …).
[[nodiscard]] bool is_reserved(std::string_view name);

/// The candidate that differs from `name` by the fewest edits, if by few enough to be a slip of the
/// pen, or that continues it (p1_1 for p1); otherwise empty.
[[nodiscard]] std::string nearest(std::string_view name, std::span<const std::string> candidates);

/// "a", "a or b", "a, b or c"; of many, the first ones and "…".
[[nodiscard]] std::string alternatives(std::span<const std::string> words);

/// The text with every byte that is not printable ASCII written as \xNN, so that a message cannot
/// carry an escape sequence.
[[nodiscard]] std::string printable(std::string_view text);

/// The printable text between single quotes, shortened for a message.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// Whether a label (a unit, a title) can stand in a report or in a comment of generated code: at
/// most 200 bytes of printable ASCII or UTF-8 beyond it, no control character, no backslash.
[[nodiscard]] bool is_label(std::string_view text) noexcept;

}  // namespace regulus::inline model
