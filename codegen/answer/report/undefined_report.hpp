// SPDX-License-Identifier: GPL-3.0-or-later
// What is told of a pose at which an expression has no value.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "codegen/answer/facts.hpp"
#include "codegen/question/analysis/undefined.hpp"

namespace regulus::detail {

[[nodiscard]] nlohmann::ordered_json json_undefined(const SearchSubject& preparation,
                                                    const Undefined& undefined);
/// Tells it under the key `undefined`.
void tell_undefined(const SearchSubject& preparation, const Undefined& undefined, Facts& facts);

}  // namespace regulus::detail
