// SPDX-License-Identifier: Apache-2.0
// Linear systems in complex doubles. Nothing is promised of the error.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "runtime/solutions/complex.hpp"

namespace regulus::detail {

/// Solves A X = B in place: on return `right` holds X, `matrix` is overwritten.
///
/// Shape     matrix: n×n; right: n×k; row-major.
/// Returns   false if elimination finds no pivot.
[[nodiscard]] bool solve_in_place(std::span<Complex> matrix, std::span<Complex> right,
                                  std::size_t n, std::size_t k = 1) noexcept;

/// Returns the inverse of an n×n matrix, approximately; nullopt if elimination finds none.
[[nodiscard]] std::optional<std::vector<Complex>> approx_inverse_of(std::vector<Complex> matrix,
                                                                    std::size_t n);

}  // namespace regulus::detail
