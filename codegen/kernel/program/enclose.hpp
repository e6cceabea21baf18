// SPDX-License-Identifier: GPL-3.0-or-later
// Expressions of constants only (15·π/180, sqrt(2)/3), enclosed in doubles through Arb.
#pragma once

#include <optional>

#include "codegen/kernel/program/interpreter.hpp"
#include "codegen/kernel/program/program.hpp"
#include "runtime/interval/interval.hpp"

namespace regulus::detail {

/// Encloses an output of a program that reads no inputs and no points.
///
/// Ensures   the value ∈ result; the bounds are neighbours, or equal if the expression folded to a
///           double. For an irrational form of a double (sin²1 + cos²1) they may be one step wider.
///           nullopt if the expression is not certainly defined.
/// Rounding  outward.
[[nodiscard]] std::optional<Interval> enclose(const Program& constant, std::size_t output = 0);

/// The narrowest double interval that contains the range from `lo` to `hi`.
///
/// Requires  lo ≤ hi.
/// Ensures   nullopt when an end is not certainly defined.
/// Rounding  outward.
[[nodiscard]] std::optional<Interval> enclose_outward(const Program& lo, const Program& hi);

/// The widest double interval inside the range from `lo` to `hi`, for witnesses.
///
/// Ensures   lo ≤ result.lo ≤ result.hi ≤ hi; nullopt when no double is certainly inside.
/// Rounding  inward.
[[nodiscard]] std::optional<Interval> round_inward(const Program& lo, const Program& hi);

/// Returns the enclosures of all nodes that depend on neither inputs nor points. A constant node
/// that is not certainly defined has no value here, so running it sets the undefined flag.
[[nodiscard]] KnownValues<Interval> enclose_constant_nodes(const Program& program);

}  // namespace regulus::detail
