// SPDX-License-Identifier: GPL-3.0-or-later
// Approximate values of a quantity at some poses, for planning only.
#pragma once

#include <vector>

#include "codegen/question/quantity/bordered.hpp"

namespace regulus::detail {

/// Returns approximate values of the quantity of `bordered` less its reference y, at up to `places`
/// poses within the constraints, with uncertain values at ends of their ranges: the middle first,
/// then places that are the same in every run. For singular values it returns ‖J⁻¹C‖_F/√n, which
/// is not above the largest and not below the least. A place where a value is not defined gives
/// none.
[[nodiscard]] std::vector<double> approx_values(const Bordered& bordered, int places);

/// Returns the same, but singular values themselves; also of |det J⁻¹|.
[[nodiscard]] std::vector<double> better_values(const Bordered& bordered, int places);

}  // namespace regulus::detail
