// SPDX-License-Identifier: GPL-3.0-or-later
// One expression of a model file replaced by another, the rest of the text left as it is.
#pragma once

#include <string>
#include <vector>

namespace regulus::inline model {

/// The text with another entry (i, j) of [matrix], counted from 1. Throws InputError when there is
/// none; whether the result is a model is for its reader to say.
[[nodiscard]] std::string with_entry(const std::string& text, int i, int j,
                                     const std::string& expression);

/// The same for a named sub-expression.
[[nodiscard]] std::string with_let(const std::string& text, const std::string& name,
                                   const std::string& expression);

/// The names of its sub-expressions.
[[nodiscard]] std::vector<std::string> let_names(const std::string& text);

}  // namespace regulus::inline model
