// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cstdint>

#include "runtime/interval/arithmetic.hpp"

namespace regulus {
namespace {

/// The number mantissa·2^exponent ≥ 0, the mantissa in [1, 2) or 0. So a power cannot overflow or
/// underflow before it is rounded to a double.
struct Scaled {
  double mantissa;
  std::int64_t exponent;
};

using DirectedProduct = double (*)(double, double) noexcept;

constexpr std::uint64_t kExponentBits = std::uint64_t{0x7ff} << 52;
constexpr std::int64_t kBias = 1023;

/// 2^e. Requires −1022 ≤ e ≤ 1023.
double power_of_two(std::int64_t e) noexcept {
  return std::bit_cast<double>(static_cast<std::uint64_t>(e + kBias) << 52);
}

/// Returns x exactly. Requires x ≥ 0 and finite.
Scaled scaled(double x) noexcept {
  if (x == 0.0) return {0.0, 0};
  const std::int64_t shift = x < 0x1p-1022 ? 64 : 0;
  const auto bits = std::bit_cast<std::uint64_t>(shift != 0 ? x * 0x1p64 : x);
  const auto exponent = static_cast<std::int64_t>((bits & kExponentBits) >> 52) - kBias;
  return {std::bit_cast<double>((bits & ~kExponentBits) | std::uint64_t{kBias} << 52),
          exponent - shift};
}

/// The product of mantissas is in [1, 4]; it is rounded as between 2^-1022 and 2^1024.
Scaled multiply(Scaled a, Scaled b, DirectedProduct product) noexcept {
  if (a.mantissa == 0.0 || b.mantissa == 0.0) return {0.0, 0};
  Scaled result = scaled(product(a.mantissa, b.mantissa));
  result.exponent += a.exponent + b.exponent;
  return result;
}

/// Returns the bound of mantissa·2^exponent on the side that `product` rounds to. All magnitudes
/// beyond 2^1100 give the same bound, and so do all below 2^-1200.
double rounded(Scaled x, DirectedProduct product) noexcept {
  if (x.exponent >= 1100) return product(kMaxDouble, 2.0);
  if (x.exponent < -1200) return x.mantissa == 0.0 ? 0.0 : product(kMinSubnormal, 0.5);
  if (x.exponent > 1023) return product(x.mantissa * 0x1p1023, power_of_two(x.exponent - 1023));
  if (x.exponent >= -1022) return x.mantissa * power_of_two(x.exponent);
  return product(x.mantissa * 0x1p-500, power_of_two(x.exponent + 500));
}

/// xⁿ by binary powering, each product rounded the same way.
/// Requires  x ≥ 0 and finite, n ≥ 1. Products of nonnegative bounds on one side stay bounds on
///           that side.
Scaled directed_power(double x, unsigned n, DirectedProduct product) noexcept {
  Scaled square = scaled(x);
  Scaled result{1.0, 0};
  for (;; square = multiply(square, square, product)) {
    if (n & 1) result = multiply(result, square, product);
    n >>= 1;
    if (n == 0) return result;
  }
}

double power_rd(double x, unsigned n) noexcept {
  return x == kInfinity ? x : rounded(directed_power(x, n, mul_rd), mul_rd);
}
double power_ru(double x, unsigned n) noexcept {
  return x == kInfinity ? x : rounded(directed_power(x, n, mul_ru), mul_ru);
}

/// Bounds x⁻ⁿ for x ≥ 0: 1 divided by the other bound of xⁿ. The mantissa of a power is in [1, 2),
/// so an inexact quotient is in (1/2, 1] and loses nothing to underflow. 1/0 is ∞, 1/∞ is 0.
double reciprocal_power_rd(double x, unsigned n) noexcept {
  if (x == kInfinity) return 0.0;
  if (x == 0.0) return kInfinity;
  const Scaled power = directed_power(x, n, mul_ru);
  Scaled result = scaled(div_rd(1.0, power.mantissa));
  result.exponent -= power.exponent;
  return rounded(result, mul_rd);
}
double reciprocal_power_ru(double x, unsigned n) noexcept {
  if (x == kInfinity) return 0.0;
  if (x == 0.0) return kInfinity;
  const Scaled power = directed_power(x, n, mul_rd);
  Scaled result = scaled(div_ru(1.0, power.mantissa));
  result.exponent -= power.exponent;
  return rounded(result, mul_ru);
}

Interval positive_power(Interval x, unsigned n) noexcept {
  if (n % 2 == 0) return {power_rd(mig(x), n), power_ru(mag(x), n)};
  return {x.lo >= 0 ? power_rd(x.lo, n) : -power_ru(-x.lo, n),
          x.hi >= 0 ? power_ru(x.hi, n) : -power_rd(-x.hi, n)};
}

/// x⁻ⁿ decreases as |x| grows, on either side of 0. x does not contain 0.
Interval negative_power(Interval x, unsigned n) noexcept {
  const Interval size{reciprocal_power_rd(mag(x), n), reciprocal_power_ru(mig(x), n)};
  return n % 2 == 1 && x.hi < 0 ? -size : size;
}

}  // namespace

Interval times_power_of_two(Interval x, int e) noexcept {
  // All steps go in the same direction, so the order of the losses does not matter.
  while (e != 0 && x != Interval(0.0)) {
    const int step = std::clamp(e, -1000, 1000);
    x = x * Interval(power_of_two(step));
    e -= step;
  }
  return x;
}

Interval pow(Interval x, int n, bool& undefined) noexcept {
  if (n == 0) return 1.0;
  if (n > 0) return positive_power(x, static_cast<unsigned>(n));
  if (contains_zero(x)) {
    undefined = true;
    return kEntire;
  }
  return negative_power(x, 0u - static_cast<unsigned>(n));
}

Interval pow(Interval x, int n) noexcept {
  bool undefined = false;
  return pow(x, n, undefined);
}

}  // namespace regulus
