// SPDX-License-Identifier: GPL-3.0-or-later
// Tells brackets of finite errors.
#pragma once

#include <string>

#include "codegen/answer/facts.hpp"
#include "codegen/question/closure/finite_error.hpp"

namespace regulus {

/// Returns "BETWEEN 0.9315 AND 0.9402 cm (x), …", or "NOT BOUNDED".
[[nodiscard]] std::string describe_result(const FiniteErrors& found);

void tell_finite_errors(const Request& request, const SearchOptions& search,
                        const FiniteErrors& found, double gap, bool is_closed, Facts& facts);

}  // namespace regulus
