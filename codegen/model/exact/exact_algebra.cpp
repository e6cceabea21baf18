// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/exact/exact_algebra.hpp"

#include <algorithm>
#include <optional>

#include "codegen/model/exact/certain_sign.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

constexpr long kLargestPrime = 1000;  ///< that is looked for under a root

/// The square root of a natural number, as a product of roots of primes as far as these are found.
ex root_of(numeric natural) {
  ex result = 1;
  for (long p = 2; p <= kLargestPrime && natural >= p * p; ++p) {
    for (; GiNaC::irem(natural, p * p).is_zero(); natural = GiNaC::iquo(natural, p * p))
      result *= p;
    if (!GiNaC::irem(natural, p).is_zero()) continue;
    natural = GiNaC::iquo(natural, p);
    result *= GiNaC::sqrt(ex(p));
  }
  return result * GiNaC::sqrt(ex(natural));
}

/// Returns n if e is sin n*pi/10, a sine or cosine that GiNaC has no root for.
std::optional<int> tenths_of_pi(const ex& e) {
  const bool is_sine = GiNaC::is_the_function<GiNaC::sin_SERIAL>(e);
  if (!is_sine && !GiNaC::is_the_function<GiNaC::cos_SERIAL>(e)) return std::nullopt;
  const ex tenths = 10 * e.op(0) / GiNaC::Pi;
  if (!GiNaC::is_a<numeric>(tenths) || !tenths.info(GiNaC::info_flags::integer))
    return std::nullopt;
  const numeric n = GiNaC::ex_to<numeric>(tenths);
  return GiNaC::mod(is_sine ? n : 5 - n, 20).to_int();
}

ex cosine_of_tenth() { return GiNaC::cos(GiNaC::Pi / 10); }

/// sin n*pi/10, by the cosine of pi/10 and the root of 5.
ex sine_of_tenths(int n) {
  if (n >= 10) return -sine_of_tenths(n - 10);
  const ex root = GiNaC::sqrt(ex(5));
  switch (std::min(n, 10 - n)) {
    case 0:
      return 0;
    case 1:
      return (root - 1) / 4;
    case 2:
      return (root - 1) / 2 * cosine_of_tenth();
    case 3:
      return (root + 1) / 4;
    case 4:
      return cosine_of_tenth();
    default:
      return 1;
  }
}

/// Rewrites roots of rationals, powers of sines, and tenths of pi. It leaves arguments of functions as they are.
struct Reduction : GiNaC::map_function {
  ex operator()(const ex& e) override {
    if (GiNaC::is_a<GiNaC::function>(e)) {
      const std::optional<int> tenths = tenths_of_pi(e);
      return tenths ? sine_of_tenths(*tenths) : e;
    }
    if (!GiNaC::is_a<GiNaC::power>(e)) return e.map(*this);
    const ex base = e.op(0), exponent = e.op(1);
    if (exponent.info(GiNaC::info_flags::posint) && exponent > 1 && tenths_of_pi(base) == 4) {
      const int n = GiNaC::ex_to<numeric>(exponent).to_int();
      return pow((5 + GiNaC::sqrt(ex(5))) / 8, n / 2) * pow(cosine_of_tenth(), n % 2);
    }
    if (GiNaC::is_a<numeric>(base) && GiNaC::is_a<numeric>(exponent))
      return root(GiNaC::ex_to<numeric>(base), GiNaC::ex_to<numeric>(exponent));
    if (GiNaC::is_the_function<GiNaC::sin_SERIAL>(base) &&
        exponent.info(GiNaC::info_flags::posint) && exponent > 1) {
      const int n = GiNaC::ex_to<numeric>(exponent).to_int();
      return pow(1 - pow(GiNaC::cos(base.op(0)), 2), n / 2) * pow(base, n % 2);
    }
    return e.map(*this);
  }

 private:
  static ex root(const numeric& base, const numeric& exponent) {
    const numeric doubled = exponent * 2;
    if (!base.is_positive() || !base.is_rational() || !doubled.is_integer())
      return GiNaC::pow(ex(base), ex(exponent));
    const numeric denominator = base.denom();
    const ex square_root = root_of(base.numer() * denominator) / denominator;
    return GiNaC::pow(square_root, doubled);
  }
};

}  // namespace

ex reduced(const ex& e) {
  if (GiNaC::is_a<numeric>(e) || GiNaC::is_a<GiNaC::symbol>(e)) return e;
  constexpr int kRounds = 8;  // one is usually enough
  ex before = e.expand();
  for (int round = 0; round < kRounds; ++round) {
    const ex after = Reduction{}(before).expand();
    if (after.is_equal(before)) break;
    before = after;
  }
  return before;
}

bool is_certainly_zero(const ex& e) { return reduced(e).is_zero(); }

bool is_certainly_nonzero(const ex& e) {
  if (has_symbols(e)) return false;
  const CertainSign sign = certain_sign(e);
  return sign == CertainSign::kNegative || sign == CertainSign::kPositive;
}

bool has_symbols(const ex& e) {
  if (GiNaC::is_a<GiNaC::symbol>(e)) return true;
  for (std::size_t i = 0; i < e.nops(); ++i)
    if (has_symbols(e.op(i))) return true;
  return false;
}

ex dot(const Point& u, const Point& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }

Point cross(const Point& u, const Point& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

Point sum(const Point& u, const Point& v) { return {u[0] + v[0], u[1] + v[1], u[2] + v[2]}; }

Point scaled(const ex& factor, const Point& v) {
  return {factor * v[0], factor * v[1], factor * v[2]};
}

Point reduced(const Point& v) { return {reduced(v[0]), reduced(v[1]), reduced(v[2])}; }

Point times(const GiNaC::matrix& R, const Point& v) {
  Point result;
  for (unsigned i = 0; i < 3; ++i) result[i] = R(i, 0) * v[0] + R(i, 1) * v[1] + R(i, 2) * v[2];
  return result;
}

Point transposed_times(const GiNaC::matrix& R, const Point& v) {
  Point result;
  for (unsigned i = 0; i < 3; ++i) result[i] = R(0, i) * v[0] + R(1, i) * v[1] + R(2, i) * v[2];
  return result;
}

}  // namespace regulus::detail
