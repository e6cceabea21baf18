// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices of intervals, row-major, as searches for solutions need them. Rounding: outward; MXCSR at
// nearest.
#pragma once

#include <span>
#include <vector>

#include "runtime/interval/interval.hpp"

namespace regulus::detail {

/// Returns K times an n×m matrix.
[[nodiscard]] std::vector<Interval> product(std::span<const double> K,
                                            std::span<const Interval> matrix, std::size_t n);

/// True if |I − A|·r < r in every component, where r is the magnitude of the steps: then all matrices of
/// A are regular.
[[nodiscard]] bool is_near_unit(std::span<const Interval> A, std::span<const Interval> steps);
/// True if that holds for some r > 0, which the powers of |I − A| lead to.
[[nodiscard]] bool is_near_unit(std::span<const Interval> A, std::size_t n);

/// Returns the sign of the determinants of an n×n matrix, by elimination; 0: not shown.
[[nodiscard]] int sign_of_determinant(std::vector<Interval> matrix, std::size_t n);

}  // namespace regulus::detail
