// SPDX-License-Identifier: GPL-3.0-or-later
// How many 512-bit operations a second this processor does at best: independent chains in
// registers, nothing loaded or stored.
#pragma once

namespace regulus::bench {

/// Operations of one call: the same for all three.
inline constexpr double kPeakOperations = 16.0 * 4096;

// Requires  a processor with AVX-512.

/// Fused multiply-adds.
void peak_fused() noexcept;
/// Additions and multiplications in turn, half of them rounded up and half down by embedded
/// rounding: the mix that bounds are made of.
void peak_bounds() noexcept;

}  // namespace regulus::bench
