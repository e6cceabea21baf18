// SPDX-License-Identifier: GPL-3.0-or-later
// A number type that runs an evaluator of runtime/interval/elementary/ on all doubles of an
// interval at once and bounds its rounding errors, like the tool Gappa.
#pragma once

#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "runtime/interval/arithmetic.hpp"
#include "runtime/interval/elementary/exact.hpp"

namespace regulus::detail::test {

/// Every value that a variable of the evaluator may have.
///
/// The ideal value is the result of the same expression without rounding, with two conventions: the
/// low part of an error-free transform is its own ideal, and so is a square root (evaluators
/// correct it by its exact residual). So high + low of a transform has the ideal of the sum or
/// product.
struct Tracked {
  Interval range;      ///< contains the computed double
  double error = 0;    ///< ≥ |computed − ideal|
  double carried = 0;  ///< the error without the last rounding
  int grid = 0;        ///< the computed double is a multiple of 2^grid

  explicit Tracked(double constant) : range(constant), grid(grid_of(constant)) {}
  Tracked(Interval r, double e, int g) : range(r), error(e), carried(e), grid(g) {}

  /// Returns an input: any double of x.
  static Tracked input(Interval x) { return {x, 0, grid_of_range(x)}; }

  static constexpr int kLeastGrid = -1074;

  static int grid_of(double x) {
    if (x == 0) return 5000;
    int exponent;
    double mantissa = std::frexp(x, &exponent);
    for (; mantissa != std::trunc(mantissa); mantissa *= 2) --exponent;
    return exponent;
  }
  static int grid_of_range(Interval x) {
    const double least = mig(x);
    return least < 0x1p-1022 ? kLeastGrid : std::ilogb(least) - 52;
  }
};

/// Returns half the distance of doubles of this size.
inline double half_ulp(double magnitude) {
  if (magnitude < 0x1p-1020) return kMinSubnormal;
  return std::ldexp(1.0, std::ilogb(magnitude) - 53);
}

inline bool is_exact(Interval result, int grid) {
  return grid >= Tracked::kLeastGrid && mag(result) <= std::ldexp(1.0, std::min(grid + 53, 1023));
}

/// Rounds a result that is a multiple of 2^grid and already has an error.
inline Tracked rounded(Interval result, double carried, int grid) {
  Tracked z(result, carried, std::max(grid, Tracked::grid_of_range(result)));
  if (!is_exact(result, grid)) z.error = add_ru(carried, half_ulp(mag(result)));
  return z;
}

inline double product_error(const Tracked& a, const Tracked& b) {
  const double mixed = add_ru(mul_ru(mag(a.range), b.error), mul_ru(mag(b.range), a.error));
  return add_ru(mixed, mul_ru(a.error, b.error));
}

inline Tracked operator-(Tracked a) {
  a.range = -a.range;
  return a;
}
inline bool is_zero(const Tracked& x) { return x.range == Interval(0.0) && x.error == 0; }
inline Tracked operator+(const Tracked& a, const Tracked& b) {
  if (is_zero(a)) return b;
  if (is_zero(b)) return a;
  return rounded(a.range + b.range, add_ru(a.error, b.error), std::min(a.grid, b.grid));
}
inline Tracked operator-(const Tracked& a, const Tracked& b) { return a + (-b); }
/// Returns true if multiplying by x only changes exponents.
inline bool is_power_of_two(const Tracked& x) {
  int exponent;
  return is_thin(x.range) && x.error == 0 && std::fabs(std::frexp(x.range.lo, &exponent)) == 0.5;
}
inline Tracked operator*(const Tracked& a, const Tracked& b) {
  if (is_power_of_two(a) && !is_power_of_two(b)) return b * a;
  if (is_power_of_two(b) && a.grid + b.grid >= Tracked::kLeastGrid)
    return {a.range * b.range, mul_ru(a.error, mag(b.range)), a.grid + b.grid};
  return rounded(a.range * b.range, product_error(a, b), a.grid + b.grid);
}
/// Uses a/b − a*/b* = (a − a*)/b + a*·(b* − b)/(b·b*).
inline Tracked operator/(const Tracked& a, const Tracked& b) {
  if (b.range == Interval(1.0) && b.error == 0) return a;
  const double least = mig(b.range);
  const double from_a = div_ru(a.error, least);
  const double from_b =
      div_ru(mul_ru(add_ru(mag(a.range), a.error), b.error), mul_rd(least, sub_rd(least, b.error)));
  return rounded(a.range / b.range, add_ru(from_a, from_b), Tracked::kLeastGrid - 1);
}

/// Requires one answer on the whole range: the pieces are chosen so.
inline std::int64_t less(const Tracked& a, const Tracked& b) {
  if (certain_less(a.range, b.range)) return -1;
  if (certain_less_equal(b.range, a.range)) return 0;
  throw std::logic_error("a comparison is not the same over the piece");
}
inline std::int64_t equal(const Tracked& a, const Tracked& b) {
  if (certain_disjoint(a.range, b.range)) return 0;
  if (a.range == b.range && is_thin(a.range)) return -1;
  throw std::logic_error("an equality is not the same over the piece");
}
inline Tracked select(std::int64_t mask, const Tracked& yes, const Tracked& no) {
  return mask ? yes : no;
}
inline Tracked magnitude(const Tracked& x) { return less(x, Tracked(0)) ? -x : x; }
/// Ignores the sign, which does not matter for an error bound.
inline Tracked with_sign_of(const Tracked& x, const Tracked&) { return x; }
inline Tracked square_root(const Tracked& x) {
  const Interval root = sqrt(x.range);
  return {root, 0, Tracked::grid_of_range(root)};
}

using TrackedParts = elementary::Parts<Tracked>;

/// Returns both parts of a result after an error-free transform.
inline TrackedParts exact_parts(Interval result, double error, int grid) {
  const double remainder = is_exact(result, grid) ? 0 : half_ulp(mag(result));
  return {Tracked(result, error, std::max(grid, Tracked::grid_of_range(result))),
          Tracked({-remainder, remainder}, 0, std::max(grid, Tracked::kLeastGrid))};
}
inline TrackedParts two_sum(const Tracked& a, const Tracked& b) {
  return exact_parts(a.range + b.range, add_ru(a.error, b.error), std::min(a.grid, b.grid));
}
inline TrackedParts fast_two_sum(const Tracked& a, const Tracked& b) {
  if (mag(a.range) != 0 && mig(a.range) < mag(b.range))
    throw std::logic_error("FastTwoSum is not exact over the piece");
  if (is_zero(a)) return {b, Tracked(0)};
  return two_sum(a, b);
}
inline TrackedParts two_product(const Tracked& a, const Tracked& b) {
  return exact_parts(a.range * b.range, product_error(a, b), a.grid + b.grid);
}

}  // namespace regulus::detail::test

namespace regulus::detail::elementary {

template <>
struct Lanes<test::Tracked> {
  using Mask = std::int64_t;
};

}  // namespace regulus::detail::elementary
