// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/kernel/call.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "runtime/interval/floating_point_scope.hpp"
#include "runtime/kernel/buffers.hpp"
#include "runtime/kernel/rounding_scope.hpp"

namespace regulus::detail {
namespace {

using ::testing::HasSubstr;

/// Returns the MXCSR during the call, and as undefined lanes the value that `context` points to.
unsigned spy(const double*, const double*, double* out, const void* context) {
  out[0] = read_mxcsr() & ~0x3fu;
  return context == nullptr ? 0 : *static_cast<const unsigned*>(context);
}

regulus_kernel two_by_two() {
  regulus_kernel kernel{};
  kernel.abi = REGULUS_KERNEL_ABI;
  kernel.variables = 3;
  kernel.motion_variables = 2;
  kernel.rows = kernel.columns = 2;
  kernel.matrix = spy;
  return kernel;
}

struct Arguments {
  BoxBatch boxes{3};
  PointRows points{4};
  OutputBatch out{4};
};

unsigned call(const regulus_kernel& kernel, Arguments& a) {
  return CheckedKernel(kernel).call(kernel.matrix, a.boxes.data(), a.points.data(), a.out.data());
}

std::string refusal(const regulus_kernel& kernel) {
  try {
    const CheckedKernel refused(kernel);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Kernel, RefusesAnotherAbi) {
  regulus_kernel kernel = two_by_two();
  kernel.abi = 7;
  EXPECT_THAT(refusal(kernel), HasSubstr("made for ABI 7, this runtime has ABI " +
                                         std::to_string(static_cast<int>(REGULUS_KERNEL_ABI))));
}

TEST(Kernel, RefusesARoundingItDoesNotKnow) {
  regulus_kernel kernel = two_by_two();
  kernel.rounding = 2;
  EXPECT_THAT(refusal(kernel), HasSubstr("unknown rounding 2"));
}

TEST(Kernel, RefusesImpossibleShapes) {
  regulus_kernel kernel = two_by_two();
  kernel.columns = 3;
  EXPECT_THAT(refusal(kernel), HasSubstr("2 rows and 3 columns"));
  kernel = two_by_two();
  kernel.motion_variables = 4;
  EXPECT_THAT(refusal(kernel), HasSubstr("4 motion parameters among 3 variables"));
}

TEST(Kernel, RefusesAKernelWithoutMatrix) {
  regulus_kernel kernel = two_by_two();
  kernel.matrix = nullptr;
  EXPECT_THAT(refusal(kernel), HasSubstr("no function for the matrix"));
}

TEST(Kernel, RunsWithTheRoundingItNeedsAndRestoresTheCallers) {
  const unsigned saved = read_mxcsr();
  for (const unsigned rounding : {REGULUS_ROUND_NEAREST, REGULUS_ROUND_UPWARD}) {
    for (const unsigned callers : {0x1f80u, 0x3f80u, 0x5f80u, 0x9fc0u}) {
      regulus_kernel kernel = two_by_two();
      kernel.rounding = rounding;
      Arguments a;
      write_mxcsr(callers);
      call(kernel, a);
      const unsigned after = read_mxcsr();
      write_mxcsr(saved);
      EXPECT_EQ(a.out.data()[0], rounding == REGULUS_ROUND_UPWARD ? 0x5f80 : 0x1f80);
      EXPECT_EQ(after & ~0x3fu, callers);
    }
  }
}

TEST(Kernel, PassesTheContextAndReportsUndefinedLanes) {
  const unsigned undefined = 0x41;
  regulus_kernel kernel = two_by_two();
  kernel.context = &undefined;
  Arguments a;
  EXPECT_EQ(call(kernel, a), 0x41u);
}

TEST(Kernel, SetsTheOutputsOfUndefinedLanesToAllNumbers) {
  const unsigned undefined = 0x41;
  regulus_kernel kernel = two_by_two();
  kernel.context = &undefined;
  Arguments a;
  a.boxes.set_all_lanes(0, {1, 2});
  a.boxes.data()[3] = 3;  // bounds in the wrong order
  std::fill_n(a.out.data(), 2 * 4 * REGULUS_LANES, 5.0);
  EXPECT_EQ(call(kernel, a), 0x49u);
  for (std::size_t e = 0; e < 4; ++e)
    for (std::size_t lane = 0; lane < REGULUS_LANES; ++lane) {
      const double lo = a.out.data()[2 * e * REGULUS_LANES + lane];
      const double hi = a.out.data()[(2 * e + 1) * REGULUS_LANES + lane];
      const bool forgotten = (0x49u >> lane & 1u) != 0;
      EXPECT_EQ(lo == -__builtin_inf() && hi == __builtin_inf(), forgotten) << e << ' ' << lane;
    }
}

TEST(Kernel, CallsAMissingFunctionUndefinedEverywhere) {
  const regulus_kernel kernel = two_by_two();
  Arguments a;
  EXPECT_EQ(CheckedKernel(kernel).call(kernel.row_scale, a.boxes.data(), nullptr, a.out.data()),
            kAllLanes);
}

TEST(Kernel, AcceptsTheLimitsOfTheContract) {
  Arguments a;
  a.boxes.set_all_lanes(2, {-0x1p64, 0x1p64});
  a.points.set_all_lanes(3, -0x1p128);
  EXPECT_EQ(call(two_by_two(), a), 0u);
}

TEST(Kernel, ReportsLanesWhoseBoxesAreOutsideTheContract) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double beyond = std::nextafter(0x1p64, 1e300);
  const double bad[][2] = {{nan, 1}, {1, nan}, {-beyond, 0}, {0, beyond}, {1, 0}, {0, kInfinity}};
  for (const auto& bounds : bad)
    for (std::size_t variable = 0; variable < 3; ++variable)
      for (std::size_t lane = 0; lane < REGULUS_LANES; ++lane) {
        Arguments a;
        a.boxes.data()[16 * variable + lane] = bounds[0];
        a.boxes.data()[16 * variable + 8 + lane] = bounds[1];
        EXPECT_EQ(call(two_by_two(), a), 1u << lane) << bounds[0] << " " << bounds[1];
      }
}

TEST(Kernel, ReportsLanesWhosePointsAreOutsideTheContract) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double beyond = std::nextafter(0x1p128, 1e300);
  for (const double bad : {nan, beyond, -beyond, kInfinity})
    for (std::size_t entry = 0; entry < 4; ++entry)
      for (std::size_t lane = 0; lane < REGULUS_LANES; ++lane) {
        Arguments a;
        a.points.set(entry, lane, bad);
        EXPECT_EQ(call(two_by_two(), a), 1u << lane) << bad;
      }
}

TEST(Kernel, AcceptsRowsOnAGrid) {
  for (const double step : {0x1p-828, 0x1p-40, 1.0, 0x1p99}) {
    Arguments a;
    a.points.set_all_lanes(0, 0x1p28 * step);
    a.points.set_all_lanes(1, -0x1fffffffp0 * step);
    a.points.set_all_lanes(2, 0x1p28 * step);
    a.points.set_all_lanes(3, step);
    EXPECT_EQ(call(two_by_two(), a), 0u) << step;
  }
}

TEST(Kernel, ReportsLanesInWhichARowOfKIsOnNoGrid) {
  const double bad[][2] = {
      {1.0, 0x1p-29}, {0x1p-29, 1.5}, {0.1, 0.0}, {0x1p-801, 0.0}, {0x1p128, 0x1.0000001p98}};
  for (const auto& entries : bad)
    for (std::size_t row = 0; row < 2; ++row)
      for (std::size_t lane = 0; lane < REGULUS_LANES; ++lane) {
        Arguments a;
        a.points.set(2 * row, lane, entries[0]);
        a.points.set(2 * row + 1, lane, entries[1]);
        EXPECT_EQ(call(two_by_two(), a), 1u << lane) << entries[0] << " " << entries[1];
      }
}

TEST(Buffers, AreAlignedAsKernelsRequire) {
  for (const std::size_t count : {1, 2, 3, 37}) {
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(BoxBatch(count).data()) % 64, 0u);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(PointRows(count).data()) % 64, 0u);
  }
}

TEST(Buffers, AreLaidOutAsKernelsRead) {
  BoxBatch boxes(2);
  boxes.set(1, 3, {-2, 5});
  EXPECT_EQ(boxes.data()[(2 * 1 + 0) * 8 + 3], -2);
  EXPECT_EQ(boxes.data()[(2 * 1 + 1) * 8 + 3], 5);
  EXPECT_EQ(boxes.get(1, 3), Interval(-2, 5));
  PointRows points(2);
  points.set(1, 6, 4);
  EXPECT_EQ(points.data()[1 * 8 + 6], 4);
}

}  // namespace
}  // namespace regulus::detail
