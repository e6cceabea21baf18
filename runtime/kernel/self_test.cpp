// SPDX-License-Identifier: Apache-2.0
#include "runtime/kernel/self_test.hpp"

#include <bit>
#include <cstdint>
#include <cstdio>
#include <iterator>

#include "runtime/kernel/buffers.hpp"
#include "runtime/kernel/rounding_scope.hpp"

extern "C" {
unsigned regulus_self_test_portable(const double*, const double*, double*, const void*);
#if defined(__x86_64__)
unsigned regulus_self_test_avx512(const double*, const double*, double*, const void*);
unsigned regulus_self_test_avx2(const double*, const double*, double*, const void*);
#endif
}

namespace regulus {

using namespace detail;

namespace {

/// The exact result, or the doubles next to it, on each side. `0.1` below is the double.
struct Expected {
  const char* operation;
  double lo, hi;
};

// Computed in exact rational arithmetic; the roots by squaring, sin 1 from its first 40 digits.
constexpr Expected kExpected[] = {
    {"1 / 3", 0x1.5555555555555p-2, 0x1.5555555555556p-2},
    {"-[-0.1, 0.3] / -3", -0x1.1111111111112p-5, 0x1.999999999999ap-4},
    {"0.1 / -3", -0x1.1111111111112p-5, -0x1.1111111111111p-5},
    {"sqrt(3)", 0x1.bb67ae8584caap+0, 0x1.bb67ae8584cabp+0},

    {"interval 0.1 * interval 3", 0x1.3333333333333p-2, 0x1.3333333333334p-2},
    {"point 0.1 * interval 3", 0x1.3333333333333p-2, 0x1.3333333333334p-2},
    {"point 0.1 * point 3", 0x1.3333333333333p-2, 0x1.3333333333334p-2},
    {"interval -0.1 * interval 0.1", -0x1.47ae147ae147cp-7, -0x1.47ae147ae147bp-7},
    {"point -0.1 * interval 0.1", -0x1.47ae147ae147cp-7, -0x1.47ae147ae147bp-7},
    {"point -0.1 * point 0.1", -0x1.47ae147ae147cp-7, -0x1.47ae147ae147bp-7},
    {"[-0.1, 0.3] * [-0.1, 0.3]", -0x1.eb851eb851eb9p-6, 0x1.70a3d70a3d70ap-4},
    {"point -0.1 * [-0.1, 0.3]", -0x1.eb851eb851eb9p-6, 0x1.47ae147ae147cp-7},

    {"point 1 + point 2^-60", 0x1p+0, 0x1.0000000000001p+0},
    {"interval 1 + point 2^-60", 0x1p+0, 0x1.0000000000001p+0},
    {"interval 1 + interval 2^-60", 0x1p+0, 0x1.0000000000001p+0},
    {"point 1 - point 2^-60", 0x1.fffffffffffffp-1, 0x1p+0},
    {"point 2^-60 - interval 1", -0x1p+0, -0x1.fffffffffffffp-1},
    {"interval -1 - interval 2^-60", -0x1.0000000000001p+0, -0x1p+0},

    {"point 0.1 * point 3 + 1", 0x1.4ccccccccccccp+0, 0x1.4cccccccccccdp+0},
    {"point 0.1 * interval 3 + 1", 0x1.4ccccccccccccp+0, 0x1.4cccccccccccdp+0},
    {"interval 3 * interval 0.1 + 1", 0x1.4ccccccccccccp+0, 0x1.4cccccccccccdp+0},
    {"point -0.1 * interval 3 + 1", 0x1.6666666666666p-1, 0x1.6666666666667p-1},
    {"point -3 * point 0.1 + 1", 0x1.6666666666666p-1, 0x1.6666666666667p-1},

    {"0.1^2", 0x1.47ae147ae147bp-7, 0x1.47ae147ae147cp-7},
    {"[-0.1, 0.3]^2", 0, 0x1.70a3d70a3d70ap-4},
    {"0.1^3", 0x1.0624dd2f1a9fcp-10, 0x1.0624dd2f1a9fdp-10},
    {"(-0.1)^3", -0x1.0624dd2f1a9fdp-10, -0x1.0624dd2f1a9fcp-10},
    {"[-0.1, 0.3]^3", -0x1.0624dd2f1a9fdp-10, 0x1.ba5e353f7ced9p-6},
    {"(-0.1)^4", 0x1.a36e2eb1c432ep-14, 0x1.a36e2eb1c432fp-14},
    {"|[-0.1, 0.3]|", 0, 0x1.3333333333333p-2},
    {"sin(1)", 0x1.aed548f090ceep-1, 0x1.aed548f090cefp-1},

    {"literal 0.1 * literal 3", 0x1.3333333333333p-2, 0x1.3333333333334p-2},
    {"literal 1 + literal 2^-60", 0x1p+0, 0x1.0000000000001p+0},
    {"literal 1 - literal 2^-60", 0x1.fffffffffffffp-1, 0x1p+0},
    {"constant 0.1 * constant 3", 0x1.3333333333333p-2, 0x1.3333333333334p-2},
    {"constant 1 / constant 3", 0x1.5555555555555p-2, 0x1.5555555555556p-2},
    {"sqrt(constant 3)", 0x1.bb67ae8584caap+0, 0x1.bb67ae8584cabp+0},
    {"literal 0.1 * literal 3 + constant 1", 0x1.4ccccccccccccp+0, 0x1.4cccccccccccdp+0},

    {"2^-600 * 2^-600", 0, 0x1p-1074},
    {"-2^-600 * 2^-600", -0x1p-1074, 0},
    {"2^-1074 + 2^-1074", 0x1p-1073, 0x1p-1073},
    {"point 3 * 2^-1074", 0x1.8p-1073, 0x1.8p-1073},

    {"lanes where 1 / [-0.1, 0.3] is undefined", 255, 255},
    {"lanes where sqrt([-0.1, 0.3]) is undefined", 255, 255},
};
constexpr std::size_t kOutputs = std::size(kExpected);

/// The number of doubles by which a bound may be outside the tightest one: sin is not correctly
/// rounded, and the portable cube takes two outward steps.
constexpr std::uint64_t kSlack = 8;

/// Returns the position of x among all doubles, counted from 0; −0 and +0 have one position.
std::int64_t ordinal(double x) {
  const auto bits = std::bit_cast<std::int64_t>(x);
  return bits < 0 ? std::int64_t{-1} * (bits & INT64_MAX) : bits;
}

/// Returns the number of doubles from `low` to `high`.
///
/// Requires  low ≤ high.
std::uint64_t doubles_between(double low, double high) {
  return std::uint64_t(ordinal(high)) - std::uint64_t(ordinal(low));
}

bool proves(Interval computed, const Expected& expected) {
  return computed.lo <= expected.lo && expected.hi <= computed.hi &&
         doubles_between(computed.lo, expected.lo) <= kSlack &&
         doubles_between(expected.hi, computed.hi) <= kSlack;
}

std::string report(const Expected& expected, Interval computed, std::size_t lane) {
  char text[320];
  std::snprintf(text, sizeof text,
                "%s, lane %zu: computed [%a, %a], but the tightest bounds are [%a, %a]",
                expected.operation, lane, computed.lo, computed.hi, expected.lo, expected.hi);
  return text;
}

BoxBatch boxes_of_the_program() {
  const Interval values[] = {1.0, 3.0, 0.1, {-0.1, 0.3}, 0x1p-600, 0x1p-1074};
  BoxBatch boxes(std::size(values));
  for (std::size_t v = 0; v < std::size(values); ++v) boxes.set_all_lanes(v, values[v]);
  return boxes;
}

PointRows points_of_the_program() {
  const double values[] = {1.0, 3.0, 0.1, 0x1p-60};
  PointRows points(std::size(values));
  for (std::size_t p = 0; p < std::size(values); ++p) points.set_all_lanes(p, values[p]);
  return points;
}

regulus_function compiled_ahead_of_time([[maybe_unused]] Isa isa) {
#if defined(__x86_64__)
  if (isa == Isa::kAvx512) return regulus_self_test_avx512;
  if (isa == Isa::kAvx2) return regulus_self_test_avx2;
#endif
  return regulus_self_test_portable;
}

}  // namespace

std::optional<std::string> check_self_test_as_is(regulus_function function, const void* context) {
  const BoxBatch boxes = boxes_of_the_program();
  const PointRows points = points_of_the_program();
  OutputBatch out(kOutputs);
  if (const unsigned undefined = function(boxes.data(), points.data(), out.data(), context))
    return "lanes " + std::to_string(undefined) + " (a bit each) are reported undefined, none is";
  const RoundingScope without_flush_to_zero(REGULUS_ROUND_NEAREST);
  for (std::size_t e = 0; e < kOutputs; ++e)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      if (!proves(out.get(e, lane), kExpected[e]))
        return report(kExpected[e], out.get(e, lane), lane);
  return std::nullopt;
}

std::optional<std::string> check_self_test(regulus_function function, Isa isa,
                                           const void* context) {
  const RoundingScope scope(required_rounding(isa));
  return check_self_test_as_is(function, context);
}

std::optional<std::string> self_test(Isa isa) {
  if (!supported(isa)) return "this processor does not support " + std::string(name(isa));
  return check_self_test(compiled_ahead_of_time(isa), isa);
}

}  // namespace regulus
