// SPDX-License-Identifier: GPL-3.0-or-later
// The unknowns of an arm that are not the same after some turns are looked for in these ranges.
#pragma once

#include <map>

#include "codegen/question/solve/arm_place.hpp"

namespace regulus::detail {

struct SlideRange {
  Interval range;        ///< more than where postures are
  bool has_all = false;  ///< false: it is the range of the model, and postures may be beyond it
};

/// Returns them by unknown: of those that slide, or that move others so that no turn brings all back.
///
/// Joints that slide one after another, without a turn between them, move the end by Σ s_k·g_k with fixed
/// directions g_k. The end's distance and those of the links bound this sum, and so each s_k if the
/// directions are independent. Others have the range of the model, and what the motion gives them.
///
/// Throws    UsageError if such an unknown has no range.
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] std::map<std::size_t, SlideRange> slide_ranges(const ArmAtPlace& arm,
                                                             const Request& request);

}  // namespace regulus::detail
