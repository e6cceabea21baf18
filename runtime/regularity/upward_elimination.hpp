// SPDX-License-Identifier: Apache-2.0
// Gaussian elimination in interval arithmetic by the rounding of the processor, which gives the
// same bounds as Interval in a fraction of the time.
#pragma once

#include <optional>

#include "runtime/regularity/determinant.hpp"

namespace regulus::detail {

/// Encloses the determinant; nullopt if a pivot before the last one contains 0, or if a bound is not
/// finite.
///
/// Rounding  outward, in any rounding mode, which stays as it was.
[[nodiscard]] std::optional<Interval> enclose_determinant_upward(const LaneMatrix& M) noexcept;

}  // namespace regulus::detail
