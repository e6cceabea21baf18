// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors and matrices of three rows, of enclosures or of enclosures with their rates.
#pragma once

#include <array>
#include <cstddef>

#include "runtime/interval/interval.hpp"

namespace regulus::detail {

template <class T>
using VectorOf = std::array<T, 3>;
template <class T>
using MatrixOf = std::array<T, 9>;  ///< row-major

/// A number that changes with another one, and its derivative by that.
struct Rated {
  Interval value = 0.0, rate = 0.0;

  Rated() = default;
  Rated(double constant) : value(constant) {}
  Rated(const Interval& constant) : value(constant) {}
  Rated(const Interval& of_value, const Interval& of_rate) : value(of_value), rate(of_rate) {}

  friend Rated operator+(const Rated& a, const Rated& b) noexcept {
    return {a.value + b.value, a.rate + b.rate};
  }
  friend Rated operator-(const Rated& a, const Rated& b) noexcept {
    return {a.value - b.value, a.rate - b.rate};
  }
  friend Rated operator*(const Rated& a, const Rated& b) noexcept {
    return {a.value * b.value, a.rate * b.value + a.value * b.rate};
  }
};

// Rounding of these functions: outward; MXCSR at nearest.

template <class T>
[[nodiscard]] VectorOf<T> operator+(const VectorOf<T>& u, const VectorOf<T>& v) noexcept {
  return {u[0] + v[0], u[1] + v[1], u[2] + v[2]};
}

template <class T>
[[nodiscard]] VectorOf<T> operator-(const VectorOf<T>& u, const VectorOf<T>& v) noexcept {
  return {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
}

template <class T>
[[nodiscard]] VectorOf<T> operator*(const T& factor, const VectorOf<T>& v) noexcept {
  return {factor * v[0], factor * v[1], factor * v[2]};
}

template <class T>
[[nodiscard]] T dot(const VectorOf<T>& u, const VectorOf<T>& v) noexcept {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

template <class T>
[[nodiscard]] VectorOf<T> cross(const VectorOf<T>& u, const VectorOf<T>& v) noexcept {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

template <class T>
[[nodiscard]] VectorOf<T> times(const MatrixOf<T>& R, const VectorOf<T>& v) noexcept {
  VectorOf<T> result;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = R[3 * i] * v[0] + R[3 * i + 1] * v[1] + R[3 * i + 2] * v[2];
  return result;
}

template <class T>
[[nodiscard]] MatrixOf<T> times(const MatrixOf<T>& A, const MatrixOf<T>& B) noexcept {
  MatrixOf<T> result;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      result[3 * i + j] = A[3 * i] * B[j] + A[3 * i + 1] * B[3 + j] + A[3 * i + 2] * B[6 + j];
  return result;
}

template <class T>
[[nodiscard]] MatrixOf<T> transposed(const MatrixOf<T>& R) noexcept {
  return {R[0], R[3], R[6], R[1], R[4], R[7], R[2], R[5], R[8]};
}

}  // namespace regulus::detail
