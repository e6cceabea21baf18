// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "regulus/codegen/jit/reader/syntax.hpp"
#include "regulus/codegen/jit/reader/token_stream.hpp"

namespace regulus::codegen::reader {

/// The statements of a function, from its brace to the one that ends it.
[[nodiscard]] std::vector<Statement> parse_body(TokenStream& tokens);

}  // namespace regulus::codegen::reader
