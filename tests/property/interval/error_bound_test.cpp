// SPDX-License-Identifier: GPL-3.0-or-later
// Proves the error bounds stated beside the evaluators of runtime/interval/elementary/: it runs
// their own code on pieces that together contain every reduced argument.
//
// Before its last rounding, a result is known up to `carried` (the rounding errors, tracked.hpp)
// plus the error of the method (computed here: the polynomial's by Arb, dropped terms by their
// formula). One step outward from the rounded result is a bound if that is at most half the
// distance to the next double; two steps are one if it is at most 1.5 distances.
#include <arb.h>
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "runtime/interval/elementary/arcsine.hpp"
#include "runtime/interval/elementary/arctangent.hpp"
#include "runtime/interval/elementary/exponential.hpp"
#include "runtime/interval/elementary/trigonometric.hpp"
#include "tests/property/interval/tracked.hpp"
#include "tests/support/polynomial_error.hpp"

namespace regulus::detail::test::error_bound {
namespace {

namespace el = elementary;

// Every formula below has a relative slack that is larger than its own rounding errors.
constexpr double kSlack = 1 + 0x1p-40;

/// Returns the part of the allowance of `steps` steps outward that is used: a bound if at most 1.
double used(const Tracked& result, double method_error, int steps) {
  const double least = mig(result.range);
  const double distance = least - next_down(least);
  return (result.carried + method_error) * kSlack / ((steps - 0.5) * distance);
}

/// Calls f on pieces [t, t'] of relative width 2^-6 that hold every double from lo up to hi; a
/// piece starts at each of `starts`. Returns the largest result.
double worst_over(double lo, double hi, std::vector<double> starts,
                  const std::function<double(Interval)>& f) {
  starts.push_back(next_up(hi));
  double worst = 0;
  double from = lo;
  for (const double end : starts) {
    while (from < end) {
      const double to = std::min(from + from * 0x1p-6, end);
      worst = std::max(worst, f({from, next_down(to)}));
      from = to;
    }
  }
  return worst;
}

/// Below this, u·(z·P(z)) underflows to 0 and the result is t, with an error of less than t³.
constexpr double kTiny = 0x1p-400;

double series_error(std::span<const double> c, const SeriesTerm& term, int weight,
                    Interval domain) {
  return PolynomialError(c, term, weight).bound(domain);
}

void reciprocal_factorial(arb_t x, slong n, slong precision) {
  arb_fac_ui(x, static_cast<ulong>(n), precision);
  arb_inv(x, x, precision);
}
void alternate(arb_t x, slong i) {
  if (i % 2 != 0) arb_neg(x, x);
}
void ratio(arb_t x, slong num, slong den, slong precision) {
  arb_set_si(x, num);
  arb_div_si(x, x, den, precision);
}

constexpr double kMostAngle = 0.7854;  // π/4 + 2^-20 at least

/// Returns the low part that reduce may leave for an r of this size: half an ulp of each high part,
/// or k·C₄.
Tracked low_part(double r) {
  const double bound = r < 0x1p-63 ? 0 : std::max(std::ldexp(1.0, std::ilogb(r) - 52), 0x1p-83);
  return {{-bound, bound}, 0, Tracked::kLeastGrid};
}

struct SinCosErrors {
  el::SinCosParts<Tracked> parts;
  double sin, cos;
};

/// Returns both parts over a piece of r > 0, and the error of the method.
SinCosErrors sin_cos_errors(Interval r) {
  static const double kSin = series_error(el::kSinCoefficients,
                                          [](arb_t x, slong i, slong p) {
                                            reciprocal_factorial(x, 2 * i + 3, p);
                                            alternate(x, i + 1);
                                          },
                                          1, {0, kMostAngle * kMostAngle});
  static const double kCos = series_error(el::kCosCoefficients,
                                          [](arb_t x, slong i, slong p) {
                                            reciprocal_factorial(x, 2 * i + 4, p);
                                            alternate(x, i);
                                          },
                                          2, {0, kMostAngle * kMostAngle});
  const double h = r.hi;
  const Tracked low = low_part(h);
  const double l = low.range.hi;
  // r.low·head replaces r.low·cos r: head is 1 − z/2 up to half an ulp, cos r up to z²/24.
  const double sin_dropped = l * (h * h * h * h / 24 + 0x1p-53) + l * l;
  const double cos_dropped = l * (h * h * h / 6) + l * l;
  const double reduction = h * 0x1p-69;
  return {el::sin_cos_parts(el::Parts<Tracked>{Tracked::input(r), low}),
          h * kSin + sin_dropped + reduction, kCos + cos_dropped + h * reduction};
}

TEST(ErrorBound, SineIsOneStepFromABound) {
  EXPECT_LE(worst_over(kTiny, kMostAngle, {},
                       [](Interval r) {
                         const SinCosErrors e = sin_cos_errors(r);
                         return used(e.parts.sin.high + e.parts.sin.low, e.sin, 1);
                       }),
            1);
}

TEST(ErrorBound, CosineIsOneStepFromABound) {
  EXPECT_LE(worst_over(kTiny, kMostAngle, {},
                       [](Interval r) {
                         const SinCosErrors e = sin_cos_errors(r);
                         return used(e.parts.cos.high + e.parts.cos.low, e.cos, 1);
                       }),
            1);
}

/// Sums the relative errors of both parts, and the error 2^-100 of the quotient itself.
double tangent_use(const TrackedParts& num, double num_method, const TrackedParts& den,
                   double den_method) {
  const Tracked n = num.high + num.low;
  const Tracked d = den.high + den.low;
  const double relative =
      (n.carried + num_method) / mig(n.range) + (d.carried + den_method) / mig(d.range) + 0x1p-100;
  const Interval q = n.range / d.range;
  const Tracked result(q, mag(q) * relative * (1 + 0x1p-40), Tracked::kLeastGrid);
  return used(result, 0, el::kTanSteps);
}

TEST(ErrorBound, TangentIsTwoStepsFromABound) {
  EXPECT_LE(worst_over(kTiny, kMostAngle, {},
                       [](Interval r) {
                         const SinCosErrors e = sin_cos_errors(r);
                         return std::max(tangent_use(e.parts.sin, e.sin, e.parts.cos, e.cos),
                                         tangent_use(e.parts.cos, e.cos, e.parts.sin, e.sin));
                       }),
            1);
}

double atan_polynomial_error() {
  return series_error(el::kAtanCoefficients,
                      [](arb_t x, slong i, slong p) {
                        ratio(x, 1, 2 * i + 3, p);
                        alternate(x, i + 1);
                      },
                      1, {0, 0.4375 * 0.4375});
}

/// Uses that the constants atan c, π/2 and π are known to 2^-107.
double atan_method_error(Interval t, double polynomial) {
  return std::min(t.hi, 0.4375) * polynomial + (t.lo < 0.4375 ? 0 : 0x1p-107);
}

const std::vector<double> kAtanStarts{0.4375, 0.6875, 1.1875, next_up(2.4375)};

TEST(ErrorBound, ArctangentIsOneStepFromABound) {
  const double polynomial = atan_polynomial_error();
  EXPECT_LE(worst_over(kTiny, 0x1p60, kAtanStarts,
                       [&](Interval t) {
                         const TrackedParts parts = el::atan_parts(Tracked::input(t));
                         return used(parts.high + parts.low, atan_method_error(t, polynomial), 1);
                       }),
            1);
}

TEST(ErrorBound, AngleIsTwoStepsFromABound) {
  const double polynomial = atan_polynomial_error();
  // 3 stands for a larger coordinate of any size: the division by it rounds.
  const Tracked larger(3);
  const auto use = [&](Interval y) {
    const Tracked smaller = Tracked::input(y);
    const double method = atan_method_error(y / Interval(3.0), polynomial);
    double worst = 0;
    for (const std::int64_t negative : {0, -1}) {
      const Tracked flat = el::angle_of(larger, negative, smaller);
      const Tracked steep = el::angle_of(smaller, negative, larger);
      worst = std::max({worst, used(flat, method + (negative ? 0x1p-106 : 0), el::kAngleSteps),
                        used(steep, method + 0x1p-107, el::kAngleSteps)});
    }
    return worst;
  };
  EXPECT_LE(worst_over(3 * kTiny, 3, {3 * 0.4375, 3 * 0.6875, 3}, use), 1);
}

double asin_polynomial_error() {
  return series_error(el::kAsinCoefficients,
                      [](arb_t x, slong i, slong p) {
                        // C(2n, n)/(4^n·(2n + 1)) with n = i + 1
                        const slong n = i + 1;
                        arb_bin_uiui(x, static_cast<ulong>(2 * n), static_cast<ulong>(n), p);
                        arb_mul_2exp_si(x, x, -2 * n);
                        arb_div_si(x, x, 2 * n + 1, p);
                      },
                      1, {0, 0.25});
}

/// Returns the error for asin and acos of |x| = t: the polynomial's; after halving, twice that, and
/// the dropped s_low·z·R(z) and second order of s_low.
double arcsine_method_error(double t, double polynomial) {
  if (t <= 0.5) return t * polynomial;
  const double s = std::sqrt((1 - t) / 2) * (1 + 0x1p-40);
  return 2 * s * (polynomial + 0x1p-53 * 0.0473 + 0x1p-105);
}

/// Chooses pieces for functions of |x| ≤ 1: near 1 they are small compared with 1 − |x|, which is a
/// double there.
double worst_over_unit(const std::function<double(Interval)>& f) {
  const auto of_complement = [&](Interval d) {
    const double lo = sub_ru(1, d.hi);
    const double hi = sub_rd(1, d.lo);
    return lo <= hi ? f({lo, hi}) : 0;
  };
  return std::max(worst_over(kTiny, 0.75, {next_up(0.5)}, f),
                  worst_over(0x1p-53, 0.25, {}, of_complement));
}

double arcsine_method_error_over(Interval t, double polynomial) {
  return std::max(arcsine_method_error(t.lo, polynomial), arcsine_method_error(t.hi, polynomial));
}

TEST(ErrorBound, ArcsineIsOneStepFromABound) {
  const double polynomial = asin_polynomial_error();
  const auto use = [&](Interval t) {
    const double constant = t.lo > 0.5 ? 0x1p-107 : 0;
    return used(el::asin_point(Tracked::input(t)),
                arcsine_method_error_over(t, polynomial) + constant, 1);
  };
  EXPECT_LE(worst_over_unit(use), 1);
  EXPECT_LE(use(Interval(1.0)), 1);
}

TEST(ErrorBound, ArccosineIsOneStepFromABound) {
  const double polynomial = asin_polynomial_error();
  const auto use = [&](Interval x, Interval t, double constant) {
    return used(el::acos_point(Tracked::input(x)),
                arcsine_method_error_over(t, polynomial) + constant, 1);
  };
  const auto both_signs = [&](Interval t) {
    return std::max(use(t, t, t.lo > 0.5 ? 0 : 0x1p-107), use(-t, t, 0x1p-106));
  };
  EXPECT_LE(worst_over_unit(both_signs), 1);
  EXPECT_LE(use(Interval(-1.0), Interval(1.0), 0x1p-106), 1);
  EXPECT_LE(use(Interval(0.0), Interval(0.0), 0x1p-107), 1);
}

TEST(ErrorBound, ExponentialIsOneStepFromABound) {
  constexpr double kMost = 0.34658;  // log(2)/2 + 2^-18 at least
  const double polynomial = series_error(
      el::kExpCoefficients, [](arb_t x, slong i, slong p) { reciprocal_factorial(x, i + 2, p); }, 2,
      {-kMost, kMost});
  const auto use = [&](Interval r) {
    const double h = mag(r);
    const double l = h * 0x1p-53;
    const Tracked low({-l, l}, 0, Tracked::kLeastGrid);
    const double dropped = l * (0.57 * h * h + 0x1p-53) + l * l + 0x1p-85;
    const TrackedParts parts = el::exp_parts(TrackedParts{Tracked::input(r), low});
    return used(parts.high + parts.low, polynomial + dropped, 1);
  };
  const auto of_magnitude = [&](Interval t) { return std::max(use(t), use(-t)); };
  EXPECT_LE(worst_over(0x1p-70, kMost, {}, of_magnitude), 1);
  EXPECT_LE(use({-0x1p-70, 0x1p-70}), 1);
}

TEST(ErrorBound, LogarithmIsOneStepFromABound) {
  constexpr double kMostS = 0.1852;  // f/(2 + f) for f = −5/16
  const double polynomial = series_error(
      el::kLogCoefficients, [](arb_t x, slong i, slong p) { ratio(x, 2, 2 * i + 3, p); }, 1,
      {0, kMostS * kMostS});
  const auto use = [&](Interval k, Interval f) {
    const TrackedParts parts = el::log_parts(Tracked(k, 0, 0), Tracked::input(f));
    const double s = mag(f / (Interval(2.0) + f));
    return used(parts.high + parts.low, s * polynomial + mag(k) * 0x1p-101, 1);
  };
  std::vector<Interval> exponents{0.0};
  for (double k = 1; k < 1100; k *= 2) {
    exponents.emplace_back(k, 2 * k - 1);
    exponents.emplace_back(1 - 2 * k, -k);
  }
  for (const Interval k : exponents) {
    EXPECT_LE(k.lo == 0 ? 0 : use(k, Interval(-0x1p-53, 0x1p-53)), 1);
    EXPECT_LE(worst_over(0x1p-53, 0.375, {}, [&](Interval f) { return use(k, f); }), 1)
        << k.lo << ' ' << k.hi;
    EXPECT_LE(worst_over(0x1p-53, 0.3125, {}, [&](Interval f) { return use(k, -f); }), 1)
        << k.lo << ' ' << k.hi;
  }
}

}  // namespace
}  // namespace regulus::detail::test::error_bound
