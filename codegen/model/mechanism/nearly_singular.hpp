// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices that are nearly singular at all poses.
#pragma once

#include <optional>

#include "codegen/model/model.hpp"

namespace regulus::detail {

/// Below this the determinant may come from the rounding of a number in the file alone.
constexpr double kNearlySingular = 1e-6;

/// Returns the largest of |det J| over the product of the lengths of J's columns at a few poses, the
/// geometry nominal, if it is below kNearlySingular; nullopt if not, or if J is not square. The ratio
/// is 1 for columns at right angles. The first rows of J, `lengths` of them, are velocities; they are
/// scaled to the size of the others. Without a claim: for a note.
[[nodiscard]] std::optional<double> approx_nearly_singular(const Model& model,
                                                           const GiNaC::matrix& J,
                                                           std::size_t lengths);

}  // namespace regulus::detail
