// SPDX-License-Identifier: GPL-3.0-or-later
// Runs an eight-lane function on every instruction set of this processor and compares it with the
// results for one interval at a time.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <ostream>

#include "runtime/interval/x8_backend.hpp"
#include "tests/property/interval/interval_printing.hpp"

namespace regulus::detail::test {

/// The expected result of one lane of an eight-lane function.
struct LaneResult {
  Interval value;
  bool undefined = false;
};

/// Eight intervals per argument or result, as the functions take them.
template <int kIntervals>
struct LaneBlock {
  alignas(64) std::array<double, 16 * kIntervals> bounds{};

  void set(int which, int lane, Interval x) {
    at(which, lane) = x.lo;
    at(which, lane, 8) = x.hi;
  }
  [[nodiscard]] Interval get(int which, int lane) { return {at(which, lane), at(which, lane, 8)}; }

 private:
  double& at(int which, int lane, int offset = 0) {
    return bounds[static_cast<std::size_t>(16 * which + offset + lane)];
  }
};

/// Kernels hold no magnitudes above 2^128: a larger result counts as undefined and reads as 0.
inline LaneResult as_lane(Interval value, bool undefined) {
  if (undefined || !(mag(value) <= 0x1p128)) return {0.0, true};
  return {value, false};
}

/// Compares bits, but ignores the sign of a zero.
template <int kIntervals>
void expect_lanes(X8Backend::Function X8Backend::*function, const LaneBlock<kIntervals>& in,
                  const std::array<LaneResult, 8>& expected) {
  for (const Isa isa : kAllIsas) {
    if (!supported(isa)) continue;
    LaneBlock<1> out;
    const unsigned undefined = (x8_backend(isa).*function)(in.bounds.data(), out.bounds.data());
    for (int lane = 0; lane < 8; ++lane) {
      const LaneResult& want = expected[static_cast<std::size_t>(lane)];
      const bool is_undefined = (undefined >> lane & 1) != 0;
      ASSERT_EQ(is_undefined, want.undefined) << "isa " << static_cast<int>(isa);
      ASSERT_EQ(out.get(0, lane), want.value) << "isa " << static_cast<int>(isa);
    }
  }
}

}  // namespace regulus::detail::test
