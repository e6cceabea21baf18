// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/property/kernel/pack_oracle.hpp"

#include <algorithm>
#include <cmath>

namespace regulus::detail::test {
namespace {

using Op = PackOperation;

bool defined_at(Op operation, const Point& at) {
  switch (operation) {
    case Op::divide:
      return at.y != 0;
    case Op::square_root:
      return at.x >= 0;
    case Op::arcsine:
    case Op::arccosine:
      return std::fabs(at.x) <= 1;
    case Op::arctangent_2:
      return at.y > 0 || at.x != 0;
    case Op::logarithm:
      return at.x > 0;
    default:
      return true;
  }
}

bool defined_on(Op operation, const Arguments& on) {
  if (operation == Op::divide) return !contains_zero(on.y);
  if (operation == Op::square_root) return on.x.lo >= 0;
  return true;
}

}  // namespace

Tightest PackOracle::arithmetic(Op operation, const Point& at) {
  const auto product = [&](double a, double b) {
    x_ = a, y_ = b;
    return tightest(result_, [&](mpfr_ptr r, mpfr_rnd_t d) { mpfr_mul(r, x_, y_, d); });
  };
  const auto sum = [&](double a, double b) {
    x_ = a, y_ = b;
    return tightest(result_, [&](mpfr_ptr r, mpfr_rnd_t d) { mpfr_add(r, x_, y_, d); });
  };
  const auto product_and_sum = [&](double a, double b, double c) {
    x_ = a, y_ = b, z_ = c;
    return tightest(result_, [&](mpfr_ptr r, mpfr_rnd_t d) { mpfr_fma(r, x_, y_, z_, d); });
  };
  const auto power = [&](unsigned long n) {
    x_ = at.x;
    return tightest(result_, [&](mpfr_ptr r, mpfr_rnd_t d) { mpfr_pow_ui(r, x_, n, d); });
  };
  switch (operation) {
    case Op::negate:
      return {-at.x, -at.x};
    case Op::negate_point:
      return {-at.p, -at.p};
    case Op::add:
      return sum(at.x, at.y);
    case Op::subtract:
      return sum(at.x, -at.y);
    case Op::multiply:
      return product(at.x, at.y);
    case Op::add_point:
    case Op::point_add:
      return sum(at.x, at.p);
    case Op::subtract_point:
      return sum(at.x, -at.p);
    case Op::point_subtract:
      return sum(at.p, -at.x);
    case Op::multiply_point:
    case Op::point_multiply:
      return product(at.x, at.p);
    case Op::points_add:
      return sum(at.p, at.q);
    case Op::points_subtract:
      return sum(at.p, -at.q);
    case Op::points_multiply:
      return product(at.p, at.q);
    case Op::literal_multiply:
      return product(-0.1, at.x);
    case Op::mul_add_points:
      return product_and_sum(at.p, at.q, at.z);
    case Op::mul_add_point:
    case Op::mul_add_by_point:
      return product_and_sum(at.p, at.x, at.z);
    case Op::mul_add_intervals:
      return product_and_sum(at.x, at.y, at.z);
    case Op::constant_multiply: {
      const Tightest least = product(0.1, at.x), greatest = product(0.3, at.x);
      return {std::min(least.lo, greatest.lo), std::max(least.hi, greatest.hi)};
    }
    case Op::square:
    case Op::power_2:
      return power(2);
    case Op::power_3:
      return power(3);
    case Op::power_4:
      return power(4);
    case Op::power_5:
      return power(5);
    case Op::power_6:
      return power(6);
    case Op::power_11:
      return power(11);
    case Op::absolute:
      return {std::fabs(at.x), std::fabs(at.x)};
    case Op::divide:
      x_ = at.x, y_ = at.y;
      return tightest(result_, [&](mpfr_ptr r, mpfr_rnd_t d) { mpfr_div(r, x_, y_, d); });
    case Op::square_root:
      x_ = at.x;
      return tightest(result_, [&](mpfr_ptr r, mpfr_rnd_t d) { mpfr_sqrt(r, x_, d); });
    case Op::check:
      return {at.x, at.x};
    default:
      return elementary(operation, at);
  }
}

Tightest PackOracle::elementary(Op operation, const Point& at) {
  x_ = at.x, y_ = at.y;
  const auto function = [&](auto f) {
    return tightest(result_, [&](mpfr_ptr r, mpfr_rnd_t d) { f(r, x_, d); });
  };
  switch (operation) {
    case Op::sine:
    case Op::sine_of_both:
      return function(mpfr_sin);
    case Op::cosine:
    case Op::cosine_of_both:
      return function(mpfr_cos);
    case Op::tangent:
      return function(mpfr_tan);
    case Op::arcsine:
      return function(mpfr_asin);
    case Op::arccosine:
      return function(mpfr_acos);
    case Op::arctangent:
      return function(mpfr_atan);
    case Op::exponential:
      return function(mpfr_exp);
    case Op::logarithm:
      return function(mpfr_log);
    default:  // arctangent_2
      return tightest(result_, [&](mpfr_ptr r, mpfr_rnd_t d) { mpfr_atan2(r, x_, y_, d); });
  }
}

std::optional<Tightest> PackOracle::at(Op operation, const Point& point) {
  if (!defined_at(operation, point)) return std::nullopt;
  return arithmetic(operation, point);
}

std::optional<Tightest> PackOracle::on(Op operation, const Arguments& on) {
  if (!defined_on(operation, on)) return std::nullopt;
  Tightest all = {kInfinity, -kInfinity};
  const auto include = [&](double x, double y, double z) {
    const Tightest one = arithmetic(operation, {x, y, z, on.p, on.q});
    all = {std::min(all.lo, one.lo), std::max(all.hi, one.hi)};
  };
  for (const double x : {on.x.lo, on.x.hi})
    for (const double y : {on.y.lo, on.y.hi})
      for (const double z : {on.z.lo, on.z.hi}) include(x, y, z);
  if (contains_zero(on.x)) include(0, on.y.lo, on.z.lo);
  return all;
}

}  // namespace regulus::detail::test
