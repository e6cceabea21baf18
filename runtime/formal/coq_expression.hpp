// SPDX-License-Identifier: Apache-2.0
// Expressions and names of a certificate in the notation of Coq.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace regulus::verifier {

/// The Coq identifier of each name.
using CoqNames = std::map<std::string, std::string, std::less<>>;

/// Returns `_name`. Neither a word of Coq nor a name of the library that a written file uses begins
/// so, whatever the model calls its quantities; and no two names become one.
[[nodiscard]] std::string coq_identifier(std::string_view name);

/// Returns an expression that `parse` accepts, in the notation of runtime/formal.
[[nodiscard]] std::string coq_expression(std::string_view text, const CoqNames& names);

/// Returns the text as it can stand in a comment of Coq, with a question mark for each byte or
/// character that is not plain (coq_tokens.hpp).
[[nodiscard]] std::string coq_comment(std::string_view text);

}  // namespace regulus::verifier
