// SPDX-License-Identifier: Apache-2.0
// Expressions of model files. They allow slightly more than those of certificates: `deg`, any
// power, names of [let] in any order.
#pragma once

#include <functional>
#include <string_view>

#include "runtime/certificate/verifier/expression.hpp"

namespace regulus::verifier {

/// Returns the node of a name. Throws Unfinished for an unknown name.
using NameMeaning = std::function<NodeId(std::string_view)>;

/// Throws Unfinished for a text that it does not understand. `depth`: how many expressions contain
/// this one.
[[nodiscard]] NodeId parse_model_expression(std::string_view text, const NameMeaning& meaning,
                                            Graph& graph, int& depth);

}  // namespace regulus::verifier
