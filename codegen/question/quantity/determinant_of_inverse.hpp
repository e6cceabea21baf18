// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "codegen/model/model.hpp"

namespace regulus::detail {

inline constexpr unsigned kMostRowsOfDeterminant = 8;

/// Returns det J⁻¹, row scales included, by the minors of the first rows: shared, not multiplied out.
///
/// Requires  a square matrix of at most kMostRowsOfDeterminant rows.
[[nodiscard]] GiNaC::ex determinant_of_inverse(const Model& model);

}  // namespace regulus::detail
