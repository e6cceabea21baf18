// SPDX-License-Identifier: GPL-3.0-or-later
// Reports of a pose at which an expression has no value.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "codegen/question/analysis/undefined.hpp"

namespace regulus {

[[nodiscard]] nlohmann::ordered_json json_undefined(const PreparedSearch& preparation,
                                                    const Undefined& undefined);
[[nodiscard]] std::string format_undefined(const PreparedSearch& preparation,
                                           const Undefined& undefined);

}  // namespace regulus
