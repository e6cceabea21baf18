// SPDX-License-Identifier: Apache-2.0
// Decides whether two expressions of a question are equal.
#pragma once

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

enum class Equality {
  kEqual,      ///< wherever both have values: exact algebra shows it
  kDifferent,  ///< at a point, or because they are different polynomials of independent atoms
  kUnknown,
};

/// Points can only show a difference: two expressions that agree at some points may differ elsewhere.
[[nodiscard]] Equality equality(Question& question, NodeId a, NodeId b);

/// Returns the poses that are expressions of other variables. An identity that holds for any pose holds
/// for these, and has shorter polynomials.
[[nodiscard]] std::vector<NodeId> poses_as_variables(const Question& question);

/// Ensures   true only if one of them is the other times a positive rational number.
[[nodiscard]] bool certain_proportional(Question& question, NodeId a, NodeId b);

}  // namespace regulus::verifier
