// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Returns the middle of the angles that are a value of the lines, nearly: half a turn from it no
/// solution is near.
///
/// Throws    Rejection if an angle is too large.
[[nodiscard]] NodeId middle_angle(const std::vector<SolutionLine>& lines, std::size_t value,
                                  Graph& graph);

}  // namespace regulus::verifier
