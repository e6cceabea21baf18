// SPDX-License-Identifier: Apache-2.0
// Complex numbers: in doubles, which prove nothing, and rectangles of them, which enclose.
#pragma once

#include "runtime/interval/interval.hpp"

namespace regulus {

/// A complex double. Unlike std::complex, a product does not look for infinities.
struct Complex {
  double re = 0;
  double im = 0;

  Complex() = default;
  explicit Complex(double real) : re(real) {}
  Complex(double real, double imaginary) : re(real), im(imaginary) {}

  friend bool operator==(const Complex&, const Complex&) = default;
};

/// All re + i·im with re and im in these intervals.
///
/// Ensures   z ∈ result of an operation for the exact z of it on any points of the arguments.
/// Rounding  outward; MXCSR at nearest.
struct Rectangle {
  Interval re;
  Interval im;

  Rectangle() = default;
  Rectangle(Interval real, Interval imaginary = 0.0) : re(real), im(imaginary) {}
  explicit Rectangle(Complex z) : re(z.re), im(z.im) {}
};

#define REGULUS_COMPLEX_ARITHMETIC(Number)                                             \
  [[nodiscard]] inline Number operator+(const Number& x, const Number& y) noexcept {   \
    return {x.re + y.re, x.im + y.im};                                                 \
  }                                                                                    \
  [[nodiscard]] inline Number operator-(const Number& x, const Number& y) noexcept {   \
    return {x.re - y.re, x.im - y.im};                                                 \
  }                                                                                    \
  [[nodiscard]] inline Number operator*(const Number& x, const Number& y) noexcept {   \
    return {x.re * y.re - x.im * y.im, x.re * y.im + x.im * y.re};                     \
  }                                                                                    \
  inline Number& operator+=(Number& x, const Number& y) noexcept { return x = x + y; } \
  inline Number& operator-=(Number& x, const Number& y) noexcept { return x = x - y; }
REGULUS_COMPLEX_ARITHMETIC(Complex)
REGULUS_COMPLEX_ARITHMETIC(Rectangle)
#undef REGULUS_COMPLEX_ARITHMETIC

[[nodiscard]] inline Complex conj(Complex z) noexcept { return {z.re, -z.im}; }
[[nodiscard]] inline double norm(Complex z) noexcept { return z.re * z.re + z.im * z.im; }
[[nodiscard]] inline Complex inverse(Complex z) noexcept {
  const double n = norm(z);
  return {z.re / n, -z.im / n};
}
[[nodiscard]] inline Complex mid(const Rectangle& z) noexcept { return {mid(z.re), mid(z.im)}; }

/// Ensures   result ≥ |re z| + |im z| for every z of the rectangle. Rounding: up.
[[nodiscard]] inline double mag_ru(const Rectangle& z) noexcept {
  return add_ru(mag(z.re), mag(z.im));
}

}  // namespace regulus
