// SPDX-License-Identifier: GPL-3.0-or-later
// Limits on the work of forming expressions. They are counts, so the result does not depend on a
// clock.
#pragma once

#include <cstdint>

namespace regulus {

/// The most terms for a determinant in closed form: of the order of a second, and twice the terms
/// of robot 2.
inline constexpr std::uint64_t kDeterminantBudget = 500000;

/// The most work for all forms together, in terms of polynomials that are produced (WorkMeter). The
/// robots in models/ need a tenth of it or less; it is of the order of seconds.
inline constexpr std::uint64_t kFormingBudget = 4'000'000;

}  // namespace regulus
