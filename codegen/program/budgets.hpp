// SPDX-License-Identifier: GPL-3.0-or-later
// How much work forming expressions may take: counts, so that the result depends on no clock.
#pragma once

#include <cstdint>

namespace regulus::inline program {

/// Terms a determinant in closed form may take: of the order of a second, and twice what robot 2
/// takes.
inline constexpr std::uint64_t kDeterminantBudget = 500000;

/// Work that all forms together may take: terms of polynomials that are produced (WorkMeter). The
/// robots in models/ take a tenth of it or less; it is of the order of seconds.
inline constexpr std::uint64_t kFormingBudget = 4'000'000;

}  // namespace regulus::inline program
