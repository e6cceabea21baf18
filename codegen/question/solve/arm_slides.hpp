// SPDX-License-Identifier: GPL-3.0-or-later
// The joints of an arm that slide are looked for in these ranges.
#pragma once

#include <map>

#include "codegen/question/solve/arm_place.hpp"

namespace regulus::detail {

struct SlideRange {
  Interval range;        ///< more than where postures are
  bool has_all = false;  ///< false: it is the range of the model, and postures may be beyond it
};

/// Returns them by joint of the chain.
///
/// Joints that slide one after another, without a turn between them, move the end by Σ s_k·g_k with fixed
/// directions g_k. The end's distance and those of the links bound this sum, and so each s_k if the
/// directions are independent. Other joints have the range of the model, and what the motion gives them.
///
/// Throws    UsageError if such a joint has no range.
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] std::map<std::size_t, SlideRange> slide_ranges(const ArmAtPlace& arm,
                                                             const Request& request);

}  // namespace regulus::detail
