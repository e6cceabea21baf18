// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "codegen/model/request.hpp"

namespace regulus::detail {

/// Returns the question about the matrix J⁻¹C: the row scales are in the entries, the columns of
/// angular velocities are divided by the characteristic length, and there is no threshold.
///
/// Requires  the matrix is an inverse Jacobian.
[[nodiscard]] Request inverse_in_one_unit(Request request);

/// Returns the factors of the columns, the diagonal of C.
[[nodiscard]] std::vector<GiNaC::ex> column_scales(const Model& model);

}  // namespace regulus::detail
