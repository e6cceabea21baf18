// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Rewrites the expressions of a question. Replaces each variable of one value only by that value.
/// If a constant decides whether an operation is defined, replaces it by its exact value if that is
/// rational: √(x − π/4) for x = π/4 becomes √0. The variables stay, though nothing depends on those
/// of one value any more. The values for a comparison with a model file also stay.
///
/// Requires  the ends of all ranges have values (enclose_variety).
/// Ensures   every expression has the same value as before, and is defined at the same points of
///           the set.
void put_in_single_values(Question& question);

/// Returns true only if two constant expressions have the same value.
///
/// Requires  both have values.
[[nodiscard]] bool are_equal(Graph& graph, NodeId a, NodeId b);

}  // namespace regulus::verifier
