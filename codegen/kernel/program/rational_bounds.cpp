// SPDX-License-Identifier: GPL-3.0-or-later
//
// All steps are exact: the only rounding is one floor of a quotient of integers, scaled so that the
// floor is an integer below 2^53. It is then a double, and so is its successor (at most 2^53), and
// scaling by a power of two is exact because the scale never goes below the subnormal grid.
#include "codegen/kernel/program/rational_bounds.hpp"

#include <cln/integer.h>

#include <cmath>
#include <limits>

namespace regulus::detail {
namespace {

constexpr long kPrecision = std::numeric_limits<double>::digits;
constexpr long kSmallestExponent = std::numeric_limits<double>::min_exponent - kPrecision;
constexpr long kLargestExponent = std::numeric_limits<double>::max_exponent;

/// x·2^shift for either sign of shift.
cln::cl_RA scale(const cln::cl_RA& x, long shift) {
  const cln::cl_I power = cln::ash(1, shift < 0 ? -shift : shift);
  return shift < 0 ? x / power : x * power;
}

/// The e with 2^e ≤ x < 2^(e+1).
long floor_log2(const cln::cl_RA& x) {
  const long e = static_cast<long>(cln::integer_length(cln::numerator(x))) -
                 static_cast<long>(cln::integer_length(cln::denominator(x)));
  return x < scale(1, e) ? e - 1 : e;
}

enum class Direction { kDown, kUp };

/// The neighbour of x > 0 on the grid of doubles, in the direction given.
double round_positive(const cln::cl_RA& x, Direction direction) {
  const long log2 = floor_log2(x);
  if (log2 >= kLargestExponent)
    return direction == Direction::kDown ? std::numeric_limits<double>::max()
                                         : std::numeric_limits<double>::infinity();
  const long grid = std::max(log2 - (kPrecision - 1), kSmallestExponent);
  const cln::cl_RA steps = scale(x, -grid);
  cln::cl_I count = cln::floor1(steps);
  if (direction == Direction::kUp && steps != count) count = count + 1;
  const auto integer = static_cast<double>(cln::cl_I_to_ulong(count));
  return std::ldexp(integer, static_cast<int>(grid));
}

}  // namespace

double round_down(const cln::cl_RA& value) {
  if (cln::zerop(value)) return 0.0;
  if (cln::plusp(value)) return round_positive(value, Direction::kDown);
  return -round_positive(-value, Direction::kUp);
}

double round_up(const cln::cl_RA& value) {
  if (cln::zerop(value)) return 0.0;
  if (cln::plusp(value)) return round_positive(value, Direction::kUp) + 0.0;
  return 0.0 - round_positive(-value, Direction::kDown);
}

Interval enclose(const cln::cl_RA& value) { return Interval{round_down(value), round_up(value)}; }

cln::cl_RA exact_rational(double x) {
  int exponent = 0;
  const double mantissa = std::ldexp(std::frexp(x, &exponent), static_cast<int>(kPrecision));
  const cln::cl_I integer = static_cast<long>(mantissa);
  return scale(integer, exponent - kPrecision);
}

long exponent_bound(const cln::cl_RA& value) {
  if (cln::zerop(value)) return std::numeric_limits<int>::min();
  return floor_log2(cln::abs(value)) + 1;
}

}  // namespace regulus::detail
