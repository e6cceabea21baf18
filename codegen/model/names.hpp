// SPDX-License-Identifier: GPL-3.0-or-later
// The names that a model file may use, and the report of an unknown one.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace regulus::detail {

/// True if the text matches [A-Za-z][A-Za-z0-9_]* (ASCII) and has at most 64 characters. Keywords
/// of C++ are allowed, because names are mangled in generated code.
[[nodiscard]] bool is_name(std::string_view text) noexcept;

/// True if the language of model files uses the name itself: pi, deg, a function, or an entry of
/// the preconditioner (k_1_1, k_1_2 …).
[[nodiscard]] bool is_reserved(std::string_view name);

/// Returns the candidate that differs from `name` by the fewest edits, if they are few enough for a
/// typing mistake, or a candidate that continues it (p1_1 for p1); otherwise empty.
[[nodiscard]] std::string nearest(std::string_view name, std::span<const std::string> candidates);

/// Returns "a", "a or b", "a, b or c"; for many words, the first ones and "…".
[[nodiscard]] std::string alternatives(std::span<const std::string> words);

/// Returns "a, b, c"; for many words, the first ones and "…".
[[nodiscard]] std::string enumeration(std::span<const std::string> words);

/// Returns "1 leg", "2 legs".
[[nodiscard]] std::string plural(std::size_t count, const std::string& noun);

/// Returns "did you mean 'WORD'?" with the nearest candidate; if none is near, `otherwise`.
[[nodiscard]] std::string suggestion(std::string_view name, std::span<const std::string> candidates,
                                     const std::string& otherwise);

/// Returns the whole characters of a text in UTF-8 that are in its first bytes.
[[nodiscard]] std::string_view first_bytes(std::string_view text, std::size_t most);

/// Returns the visible text (visible_text.hpp) between single quotes, shortened for a message.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// True if a label (a unit, a title) can appear in a report or in a comment of generated code: at
/// most 200 bytes of printable ASCII or UTF-8 beyond it, no control character, no backslash.
[[nodiscard]] bool is_label(std::string_view text) noexcept;

}  // namespace regulus::detail
