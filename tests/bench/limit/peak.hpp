// SPDX-License-Identifier: GPL-3.0-or-later
// Measures the most 512-bit operations a second of this processor: independent chains in registers,
// without loads or stores.
#pragma once

namespace regulus::detail::bench {

/// The number of operations in one call, the same for each function.
inline constexpr double kPeakOperations = 16.0 * 4096;

// Requires  a processor with AVX-512.

/// Executes fused multiply-adds.
void peak_fused() noexcept;
/// Executes additions and multiplications in turn, half of them rounded up and half down by
/// embedded rounding. Bounds consist of this mix.
void peak_bounds() noexcept;

}  // namespace regulus::detail::bench
