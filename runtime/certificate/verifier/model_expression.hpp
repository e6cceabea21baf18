// SPDX-License-Identifier: Apache-2.0
// Expressions of model files, which are a little more than those of certificates: `deg`, any power,
// names of [let] in any order.
#pragma once

#include <functional>
#include <string_view>

#include "runtime/certificate/verifier/expression.hpp"

namespace regulus::verifier {

/// The node that a name stands for. Throws Unfinished for one that is not known.
using NameMeaning = std::function<NodeId(std::string_view)>;

/// Throws Unfinished for a text that it does not understand. `depth`: of the expressions that this
/// one is a part of.
[[nodiscard]] NodeId parse_model_expression(std::string_view text, const NameMeaning& meaning,
                                            Graph& graph, int& depth);

}  // namespace regulus::verifier
