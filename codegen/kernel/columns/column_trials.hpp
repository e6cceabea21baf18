// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "codegen/kernel/symbolic/expression.hpp"

namespace regulus::detail {

/// Column `target` += multiplier · column `source`; counted from 0.
struct AppliedOperation {
  int target = 0;
  int source = 0;
  Expression multiplier;
};

/// The column operations that were tried and kept, and the figures that decided. A radius is an
/// approximate spectral radius of the bounds over boxes of the motion: below 1 the bounds certify.
struct ColumnTrials {
  std::vector<AppliedOperation> tried;            ///< in their order; empty: none saves a term
  std::vector<AppliedOperation> kept;             ///< none, all tried, or all with half multipliers
  std::size_t terms_before = 0, terms_after = 0;  ///< of A multiplied out, and after all tried
  int halvings = 0;   ///< of the motion until A's bounds certify a box, the most on eight ways
  double radius = 0;  ///< of A
  double radius_of_all = 0;   ///< after all tried; 0: not compared
  double radius_of_half = 0;  ///< with half of each multiplier
  bool complete = true;       ///< false: A has too many terms to look at all operations
};

}  // namespace regulus::detail
