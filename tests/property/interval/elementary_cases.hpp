// SPDX-License-Identifier: GPL-3.0-or-later
// The unary elementary functions: their inputs, their true values by Arb, and their budgets.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "runtime/interval/elementary.hpp"
#include "runtime/interval/x8_backend.hpp"
#include "tests/support/arb_oracle.hpp"
#include "tests/support/corner_inputs.hpp"

namespace regulus::detail::test {

/// The tight enclosure of a function over an interval, unless it is undefined somewhere there.
struct Truth {
  Interval range;
  bool undefined = false;
};

struct ElementaryCase {
  std::string name;
  Interval (*scalar)(Interval, bool& undefined) noexcept;
  X8Backend::Function X8Backend::*eight_lanes;
  Truth (*truth)(ArbOracle&, Interval);
  CornerInputs inputs;
  std::uint64_t budget;  ///< how many ulp a bound may lie outside the tight one
};

inline void PrintTo(const ElementaryCase& function, std::ostream* out) { *out << function.name; }

/// Computes the tight enclosures at both ends; for a point, only once.
struct Ends {
  Interval at_lo, at_hi;
};
inline Ends ends(ArbOracle& arb, ArbOracle::Unary f, Interval x) {
  const Interval at_lo = arb.tight(f, x.lo);
  return {at_lo, is_thin(x) ? at_lo : arb.tight(f, x.hi)};
}

inline Truth increasing(ArbOracle& arb, ArbOracle::Unary f, Interval x) {
  const Ends y = ends(arb, f, x);
  return {{y.at_lo.lo, y.at_hi.hi}};
}

inline bool beyond_limit(Interval x) { return mag(x) > kTrigonometricLimit; }

/// Encloses a wave with maxima at (maximum + 4n)·π/2 and minima two quarter turns later.
inline Truth wave(ArbOracle& arb, ArbOracle::Unary f, Interval x, int maximum) {
  if (beyond_limit(x)) return {{-1, 1}};
  const Ends y = ends(arb, f, x);
  Interval range = hull(y.at_lo, y.at_hi);
  const auto passes = [&](int offset) {
    return !is_thin(x) && arb.turns(x.lo, offset, 4) < arb.turns(x.hi, offset, 4);
  };
  if (passes(maximum)) range.hi = 1;
  if (passes(maximum + 2)) range.lo = -1;
  return {range};
}

inline Truth true_sin(ArbOracle& arb, Interval x) { return wave(arb, arb_sin, x, 1); }
inline Truth true_cos(ArbOracle& arb, Interval x) { return wave(arb, arb_cos, x, 0); }
inline Truth true_tan(ArbOracle& arb, Interval x) {
  if (beyond_limit(x)) return {{}, true};
  if (!is_thin(x) && arb.turns(x.lo, 1, 2) < arb.turns(x.hi, 1, 2)) return {{}, true};
  return increasing(arb, arb_tan, x);
}
/// Avoids Arb for tiny x, where it needs thousands of bits to tell asin x from x. For 0 < x <
/// 2^-27, asin x exceeds x by less than x³ < x·2^-54, so it is between x and the next double.
inline Interval tight_asin(ArbOracle& arb, double x) {
  if (x == 0 || std::fabs(x) >= 0x1p-27) return arb.tight(arb_asin, x);
  return x > 0 ? Interval{x, next_up(x)} : Interval{next_down(x), x};
}
inline Truth true_asin(ArbOracle& arb, Interval x) {
  if (mag(x) > 1) return {{}, true};
  const Interval at_lo = tight_asin(arb, x.lo);
  return {{at_lo.lo, is_thin(x) ? at_lo.hi : tight_asin(arb, x.hi).hi}};
}
inline Truth true_acos(ArbOracle& arb, Interval x) {
  if (mag(x) > 1) return {{}, true};
  const Ends y = ends(arb, arb_acos, x);
  return {{y.at_hi.lo, y.at_lo.hi}};
}
inline Truth true_atan(ArbOracle& arb, Interval x) { return increasing(arb, arb_atan, x); }
inline Truth true_exp(ArbOracle& arb, Interval x) {
  // Arb's exponents are unbounded; far outside the range of doubles it would only take time.
  const auto near = [](double t) { return std::clamp(t, -800.0, 800.0); };
  return increasing(arb, arb_exp, {near(x.lo), near(x.hi)});
}
inline Truth true_log(ArbOracle& arb, Interval x) {
  if (x.lo <= 0) return {{}, true};
  return increasing(arb, arb_log, x);
}

inline Interval total_sin(Interval x, bool&) noexcept { return sin(x); }
inline Interval total_cos(Interval x, bool&) noexcept { return cos(x); }
inline Interval total_atan(Interval x, bool&) noexcept { return atan(x); }
inline Interval total_exp(Interval x, bool&) noexcept { return exp(x); }

/// Different seeds give different inputs, the same seed the same ones.
inline std::vector<ElementaryCase> elementary_cases(std::uint64_t seed_base) {
  const double turn = 0x1.1p20;
  const auto angles = [=](std::uint64_t seed) {
    return CornerInputs(seed_base + seed, -turn, turn)
        .with({kTrigonometricLimit, 0.7853981633974483})
        .with_quarter_turns();
  };
  const auto sines = [=](std::uint64_t seed) {
    return CornerInputs(seed_base + seed, -0x1.001p0, 0x1.001p0).with({0.5, 1, 0.7071067811865476});
  };
  const auto slopes = CornerInputs(seed_base + 6).with({0.4375, 0.6875, 1.1875, 2.4375, 1e17});
  const auto exponents =
      CornerInputs(seed_base + 7, -760, 720).with({709.78, 745.13, 708.4, 88.72, 0.34657});
  const auto positives =
      CornerInputs(seed_base + 8, -0x1p-1000).with({0.6875, 1.375, 0x1p-1022, 1});
  return {{"sin", total_sin, &X8Backend::sin, true_sin, angles(1), 2},
          {"cos", total_cos, &X8Backend::cos, true_cos, angles(2), 2},
          {"tan", tan, &X8Backend::tan, true_tan, angles(3), 4},
          {"asin", asin, &X8Backend::asin, true_asin, sines(4), 2},
          {"acos", acos, &X8Backend::acos, true_acos, sines(5), 2},
          {"atan", total_atan, &X8Backend::atan, true_atan, slopes, 2},
          {"exp", total_exp, &X8Backend::exp, true_exp, exponents, 3},
          {"log", log, &X8Backend::log, true_log, positives, 2}};
}

}  // namespace regulus::detail::test
