// SPDX-License-Identifier: GPL-3.0-or-later
// The values of two joints a and b of a loop J_a·M·J_b = N that follow from the others. Joint b turns.
#pragma once

#include <optional>

#include "codegen/question/solve/arm_chain.hpp"

namespace regulus::detail {

struct PairInLoop {
  const ArmJoint &a, &b;
  LinkFrame M, N;  ///< what is between them, by the values of the others
};

[[nodiscard]] std::array<double, 2> approx_values(const PairInLoop& loop);

/// Encloses them wherever the others have all the values of M and N; nullopt: the axes may be the same there.
///
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] std::optional<std::array<Interval, 2>> enclose_values(const PairInLoop& loop);

}  // namespace regulus::detail
