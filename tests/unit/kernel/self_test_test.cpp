// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/kernel/self_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "runtime/interval/floating_point_scope.hpp"

extern "C" {
unsigned regulus_self_test_avx512(const double*, const double*, double*, const void*);
unsigned regulus_self_test_avx2(const double*, const double*, double*, const void*);
unsigned regulus_self_test_portable(const double*, const double*, double*, const void*);
}

namespace regulus::detail {
namespace {

using ::testing::HasSubstr;

constexpr unsigned kMaskedNearest = 0x1f80;
constexpr unsigned kDownward = 0x2000, kUpward = 0x4000, kTowardZero = 0x6000;
constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x0040;

/// Returns the outcome under an MXCSR that the caller sets.
std::optional<std::string> under(unsigned mxcsr, regulus_function function) {
  const unsigned saved = read_mxcsr();
  write_mxcsr(mxcsr);
  auto result = check_self_test_as_is(function);
  write_mxcsr(saved);
  return result;
}

TEST(SelfTest, PassesForEveryInstructionSetOfThisProcessor) {
  for (const Isa isa : kAllIsas) {
    if (!supported(isa)) continue;
    const auto failure = self_test(isa);
    EXPECT_FALSE(failure) << name(isa) << ": " << *failure;
  }
}

TEST(SelfTest, KeepsTheCallersFloatingPointEnvironment) {
  const unsigned saved = read_mxcsr();
  const unsigned unusual = kMaskedNearest | kDownward | kFlushToZero;
  write_mxcsr(unusual);
  const auto failure = self_test(best_isa());
  const unsigned after = read_mxcsr();
  write_mxcsr(saved);
  EXPECT_FALSE(failure);
  EXPECT_EQ(after & ~0x3fu, unusual);
}

TEST(SelfTest, Avx512PassesInEveryRoundingMode) {
  if (!supported(Isa::kAvx512)) GTEST_SKIP() << "needs AVX-512";
  for (const unsigned mode : {0u, kDownward, kUpward, kTowardZero})
    EXPECT_FALSE(under(kMaskedNearest | mode, regulus_self_test_avx512)) << mode;
}

TEST(SelfTest, Avx2FailsInEveryModeButUpward) {
  if (!supported(Isa::kAvx2)) GTEST_SKIP() << "needs AVX2";
  EXPECT_FALSE(under(kMaskedNearest | kUpward, regulus_self_test_avx2));
  for (const unsigned mode : {0u, kDownward, kTowardZero})
    EXPECT_TRUE(under(kMaskedNearest | mode, regulus_self_test_avx2)) << mode;
}

unsigned with_an_infinite_bound(const double* boxes, const double* points, double* out,
                                const void* data) {
  const unsigned undefined = regulus_self_test_portable(boxes, points, out, data);
  out[0] = -std::numeric_limits<double>::infinity();
  return undefined;
}

TEST(SelfTest, FailsForABoundThatIsInfinite) {
  EXPECT_FALSE(under(kMaskedNearest, regulus_self_test_portable));
  EXPECT_TRUE(under(kMaskedNearest, with_an_infinite_bound));
}

TEST(SelfTest, FailsWhenSubnormalsAreFlushed) {
  for (const unsigned flush : {kFlushToZero, kDenormalsAreZero}) {
    EXPECT_TRUE(under(kMaskedNearest | flush, regulus_self_test_portable)) << flush;
    if (supported(Isa::kAvx2)) {
      EXPECT_TRUE(under(kMaskedNearest | kUpward | flush, regulus_self_test_avx2)) << flush;
    }
    if (supported(Isa::kAvx512)) {
      EXPECT_TRUE(under(kMaskedNearest | flush, regulus_self_test_avx512)) << flush;
    }
  }
}

// Each of these programs differs from the portable one in one respect.

constexpr int kOutputs = 44;

template <int kOutput>
unsigned merges_both_roundings(const double* boxes, const double* points, double* out,
                               const void* context) {
  const unsigned undefined = regulus_self_test_portable(boxes, points, out, context);
  for (int lane = 0; lane < 8; ++lane) out[16 * kOutput + lane] = out[16 * kOutput + 8 + lane];
  return undefined;
}

TEST(SelfTest, FailsWhenTheRoundingsOfOneThirdAreMerged) {
  const auto failure = check_self_test(merges_both_roundings<0>, Isa::kPortable);
  ASSERT_TRUE(failure);
  EXPECT_THAT(*failure, HasSubstr("1 / 3, lane 0"));
  EXPECT_THAT(*failure, HasSubstr("[0x1.5555555555555p-2, 0x1.5555555555556p-2]"));
}

TEST(SelfTest, FailsWhenLiteralsAreFoldedToNearest) {
  const auto failure = check_self_test(merges_both_roundings<31>, Isa::kPortable);
  ASSERT_TRUE(failure);
  EXPECT_THAT(*failure, HasSubstr("literal 0.1 * literal 3"));
}

unsigned is_wrong_in_the_last_lane(const double* boxes, const double* points, double* out,
                                   const void* context) {
  const unsigned undefined = regulus_self_test_portable(boxes, points, out, context);
  out[16 * (kOutputs - 3) + 7] *= 2;
  return undefined;
}

TEST(SelfTest, LooksAtEveryLane) {
  const auto failure = check_self_test(is_wrong_in_the_last_lane, Isa::kPortable);
  ASSERT_TRUE(failure);
  EXPECT_THAT(*failure, HasSubstr("lane 7"));
}

unsigned knows_nothing(const double* boxes, const double* points, double* out,
                       const void* context) {
  const unsigned undefined = regulus_self_test_portable(boxes, points, out, context);
  for (int lane = 0; lane < 8; ++lane) out[lane] = -1, out[8 + lane] = 1;
  return undefined;
}

TEST(SelfTest, FailsWhenBoundsEncloseButAreFarAway) {
  EXPECT_TRUE(check_self_test(knows_nothing, Isa::kPortable));
}

unsigned calls_a_lane_undefined(const double* boxes, const double* points, double* out,
                                const void* context) {
  return regulus_self_test_portable(boxes, points, out, context) | 16;
}

TEST(SelfTest, FailsWhenALaneIsCalledUndefined) {
  EXPECT_TRUE(check_self_test(calls_a_lane_undefined, Isa::kPortable));
}

}  // namespace
}  // namespace regulus::detail
