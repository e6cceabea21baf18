// SPDX-License-Identifier: GPL-3.0-or-later
// By how much a loop that was cut is open, in doubles and as exact expressions.
#pragma once

#include <ginac/ginac.h>

#include <vector>

#include "codegen/model/import/loop_cut.hpp"

namespace regulus::detail {

/// The parts of a gap; all are 0 where the loop is closed.
///
/// Ball      three coordinates.
/// Hinge     three coordinates, and those of the difference of its axes on both sides.
/// Weld      three coordinates, and the nine entries of the difference of two rotations.
/// Rod       the difference of two squared lengths.
template <class T>
[[nodiscard]] std::vector<T> gap_of(const CutLoop& loop, const std::vector<LoopJoint>& joints,
                                    const std::vector<T>& variables);

/// By how much a loop is open: the largest part of its gap; of a rod, the difference of the lengths.
[[nodiscard]] double opening_of(const CutLoop& loop, const std::vector<LoopJoint>& joints,
                                const std::vector<double>& variables);

extern template std::vector<double> gap_of(const CutLoop&, const std::vector<LoopJoint>&,
                                           const std::vector<double>&);
extern template std::vector<GiNaC::ex> gap_of(const CutLoop&, const std::vector<LoopJoint>&,
                                              const std::vector<GiNaC::ex>&);

}  // namespace regulus::detail
