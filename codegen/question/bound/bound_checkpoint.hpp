// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "codegen/question/margin/bracket_checkpoint.hpp"
#include "codegen/question/quantity/quantity.hpp"

namespace regulus::detail {

/// Returns everything that the ends of brackets of a quantity depend on.
[[nodiscard]] nlohmann::ordered_json checkpointed_question(const Request& request,
                                                           const Quantity& quantity,
                                                           const SearchOptions& search);

}  // namespace regulus::detail
