// SPDX-License-Identifier: GPL-3.0-or-later
// Singular places at which every variable has a simple value: a multiple of pi/12, a short decimal,
// or the end of its range. Arms of seven joints lose rank at many such places, and no sign changes
// there.
#pragma once

#include <optional>
#include <span>

#include "codegen/question/engine/pipeline.hpp"
#include "runtime/problem/problem.hpp"

namespace regulus::detail {

/// Descends to singular places, first from the middle of `box`, moves their coordinates to simple
/// values one by one, and decides by exact algebra (exact_rank.hpp). Its effort is bounded: the
/// evaluations of one report.
///
/// Ensures   as AlgebraOracle::find_singular says; nullopt if it finds none, and for models with
///           points in balls. Depends on the preparation and the box alone.
[[nodiscard]] std::optional<ExactPlace> find_exact_place(const PreparedSearch& preparation,
                                                         std::span<const Interval> box);

}  // namespace regulus::detail
