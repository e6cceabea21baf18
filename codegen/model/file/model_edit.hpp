// SPDX-License-Identifier: GPL-3.0-or-later
// Replaces one expression of a model file, or its six legs by their matrix, and leaves the rest of the
// text as it is.
#pragma once

#include <string>
#include <vector>

namespace regulus::detail {

/// Returns the text with another entry (i, j) of [matrix], counted from 1. Throws InputError if
/// there is no such entry. It does not check that the result is a model; the reader does. The key
/// `edited` of [matrix] names the entry.
[[nodiscard]] std::string with_entry(const std::string& text, int i, int j,
                                     const std::string& expression);

/// The same for a named sub-expression.
[[nodiscard]] std::string with_let(const std::string& text, const std::string& name,
                                   const std::string& expression);

/// Returns the names of its sub-expressions.
[[nodiscard]] std::vector<std::string> let_names(const std::string& text);

/// True if the model file describes its robot by [gough].
[[nodiscard]] bool is_gough(const std::string& text);

/// Returns the text with [pose], constants and [matrix] in place of [gough]: the same question, with the
/// same names and groups, and no drawing. All other lines stay. Throws InputError if [gough],
/// [geometry] or [let] are not tables with a line of their own.
[[nodiscard]] std::string with_matrix_of_gough(const std::string& text);

}  // namespace regulus::detail
