// SPDX-License-Identifier: GPL-3.0-or-later
// A quantity may be 0 everywhere, and no bracket is narrow relative to 0.
#pragma once

#include "codegen/question/quantity/quantity.hpp"

namespace regulus::detail {

/// A value counts as 0 if it is less than this part of what causes it.
inline constexpr double kNegligiblePart = 0x1p-20;

/// Why an end at 0 has no proof.
inline constexpr const char* kNothingAtZero = "every magnitude is at least 0";

/// Returns kNegligiblePart of the largest load, twist, error or speed that causes the quantity, about. 0
/// for a quantity that has no such cause, and for a finite error, whose causes are in the motion.
[[nodiscard]] double negligible(const Model& model, const Component& component);

}  // namespace regulus::detail
