// SPDX-License-Identifier: Apache-2.0
// Expressions of model files. They allow slightly more than those of certificates: `deg`, any
// power, names of [let] in any order.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <string_view>

#include "runtime/verifier/expression.hpp"

namespace regulus::verifier {

/// Returns the node of a name. Throws Unfinished for an unknown name.
using NameMeaning = std::function<NodeId(std::string_view)>;

/// Throws Unfinished for a text that it does not understand. `depth`: how many expressions contain
/// this one.
///
/// A pose parameter whose unit is degrees is a number of degrees, and its name in an expression is
/// the angle. `degrees` has the names of these parameters. In a value of one of them
/// (`is_in_degrees`), outside the arguments of sin, cos and tan, `deg` is 1 and such names are
/// numbers of degrees.
[[nodiscard]] NodeId parse_model_expression(std::string_view text, const NameMeaning& meaning,
                                            Graph& graph, int& depth,
                                            const std::set<std::string, std::less<>>& degrees,
                                            bool is_in_degrees);

}  // namespace regulus::verifier
