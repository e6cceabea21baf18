// SPDX-License-Identifier: GPL-3.0-or-later
// Replaces one expression of a model file and leaves the rest of the text as it is.
#pragma once

#include <string>
#include <vector>

namespace regulus {

/// Returns the text with another entry (i, j) of [matrix], counted from 1. Throws InputError if
/// there is no such entry. It does not check that the result is a model; the reader does.
[[nodiscard]] std::string with_entry(const std::string& text, int i, int j,
                                     const std::string& expression);

/// The same for a named sub-expression.
[[nodiscard]] std::string with_let(const std::string& text, const std::string& name,
                                   const std::string& expression);

/// Returns the names of its sub-expressions.
[[nodiscard]] std::vector<std::string> let_names(const std::string& text);

}  // namespace regulus
