// SPDX-License-Identifier: Apache-2.0
#include "runtime/solutions/linear_system.hpp"

#include <algorithm>
#include <cmath>

namespace regulus::detail {

namespace {

std::size_t pivot_row(std::span<const Complex> matrix, std::size_t n, std::size_t column) noexcept {
  std::size_t pivot = column;
  for (std::size_t i = column + 1; i < n; ++i)
    if (norm(matrix[i * n + column]) > norm(matrix[pivot * n + column])) pivot = i;
  return pivot;
}

void swap_rows(std::span<Complex> matrix, std::size_t width, std::size_t a, std::size_t b) {
  if (a == b) return;
  const auto row = [&](std::size_t i) {
    return matrix.begin() + static_cast<std::ptrdiff_t>(i * width);
  };
  std::swap_ranges(row(a), row(a + 1), row(b));
}

}  // namespace

bool solve_in_place(std::span<Complex> matrix, std::span<Complex> right, std::size_t n,
                    std::size_t k) noexcept {
  for (std::size_t c = 0; c < n; ++c) {
    const std::size_t pivot = pivot_row(matrix, n, c);
    if (!(norm(matrix[pivot * n + c]) > 0)) return false;
    swap_rows(matrix, n, c, pivot);
    swap_rows(right, k, c, pivot);
    const Complex reciprocal = inverse(matrix[c * n + c]);
    for (std::size_t j = c + 1; j < n; ++j) matrix[c * n + j] = matrix[c * n + j] * reciprocal;
    for (std::size_t j = 0; j < k; ++j) right[c * k + j] = right[c * k + j] * reciprocal;
    for (std::size_t i = c + 1; i < n; ++i) {
      const Complex factor = matrix[i * n + c];
      if (factor == Complex{}) continue;
      for (std::size_t j = c + 1; j < n; ++j) matrix[i * n + j] -= factor * matrix[c * n + j];
      for (std::size_t j = 0; j < k; ++j) right[i * k + j] -= factor * right[c * k + j];
    }
  }
  for (std::size_t c = n; c-- > 1;)
    for (std::size_t i = 0; i < c; ++i)
      for (std::size_t j = 0; j < k; ++j) right[i * k + j] -= matrix[i * n + c] * right[c * k + j];
  return true;
}

std::optional<std::vector<Complex>> approx_inverse_of(std::vector<Complex> matrix, std::size_t n) {
  std::vector<Complex> inverse(n * n);
  for (std::size_t i = 0; i < n; ++i) inverse[i * n + i] = {1, 0};
  const bool found = solve_in_place(matrix, inverse, n, n) &&
                     std::ranges::all_of(inverse, [](Complex z) { return std::isfinite(norm(z)); });
  return found ? std::optional(std::move(inverse)) : std::nullopt;
}

}  // namespace regulus::detail
