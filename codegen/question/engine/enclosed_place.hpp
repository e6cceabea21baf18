// SPDX-License-Identifier: GPL-3.0-or-later
// Singular places in general position, where rank is lost transversally: the place and the null vector
// are enclosed by a test of existence (runtime/existence/null_vector.hpp).
#pragma once

#include <optional>
#include <span>

#include "codegen/question/engine/pipeline.hpp"
#include "runtime/problem/problem.hpp"

namespace regulus::detail {

/// Descends to singular places, first from the middle of `box`. There it chooses the variables that move
/// the matrix out of rank loss most, relative to their ranges, among those that are inside their ranges;
/// it fixes the others.
///
/// Ensures   as AlgebraOracle::enclose_singular says; nullopt if it finds none. Depends on the
///           preparation and the box alone. Its effort is bounded: the evaluations of one report.
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] std::optional<EnclosedPlace> find_enclosed_place(const PreparedSearch& preparation,
                                                               std::span<const Interval> box);

}  // namespace regulus::detail
