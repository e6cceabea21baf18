// SPDX-License-Identifier: GPL-3.0-or-later
// The functions a model file may call, with the domains on which they are real.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "codegen/model/exact/parsed_expression.hpp"

namespace regulus::detail {

/// sqrt sin cos tan asin acos atan atan2 exp log abs.
[[nodiscard]] std::span<const std::string> function_names();

[[nodiscard]] bool is_function(std::string_view name);

/// Applies the function to the arguments; records its domain if it is not defined everywhere.
///
/// Requires  is_function(name).
/// Ensures   throws ParseRefusal for a wrong number of arguments, or constants outside the domain.
[[nodiscard]] ParsedExpression call(std::string_view name, std::vector<ParsedExpression> arguments);

}  // namespace regulus::detail
