// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/machine/frame_slots.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "runtime/interval/interval.hpp"
#include "runtime/kernel/call.hpp"
#include "runtime/machine/machine_kernel.hpp"

namespace regulus::detail::machine {
namespace {

using Op = PackOperation;

/// Computes x + 1, x + 2 … x + count, and then their sum: all are alive at once.
PackKernel sum_of(std::uint32_t count) {
  PackKernel k;
  k.variables = k.motion_variables = k.rows = k.columns = 1;
  PackFunction& f = k.functions[static_cast<std::size_t>(KernelFunction::kMatrix)];
  f.code.push_back({Op::kLoad, 0});
  for (std::uint32_t i = 0; i < count; ++i) {
    f.constants.push_back(Interval(i + 1));
    f.code.push_back({Op::kConstant, i});
  }
  for (std::uint32_t i = 0; i < count; ++i) f.code.push_back({Op::kAdd_II, 0, 1 + i});
  for (std::uint32_t i = 1; i < count; ++i) {
    const auto last = static_cast<std::uint32_t>(f.code.size()) - 1;
    f.code.push_back({Op::kAdd_II, i == 1 ? count + 1 : last, count + 1 + i});
  }
  f.code.push_back({Op::kStore, 0, 0, static_cast<std::uint32_t>(f.code.size()) - 1});
  f.part_ends = {static_cast<std::uint32_t>(f.code.size())};
  f.outputs = 1;
  return k;
}

void expect_sum(std::uint32_t count) {
  const MachineKernel machine(sum_of(count), best_isa());
  const CheckedKernel kernel(*machine.get());
  alignas(64) double boxes[2 * REGULUS_LANES], out[2 * REGULUS_LANES];
  for (int lane = 0; lane < REGULUS_LANES; ++lane) boxes[lane] = boxes[REGULUS_LANES + lane] = lane;
  EXPECT_EQ(kernel.call(kernel.functions().matrix, boxes, nullptr, out), 0U);
  for (int lane = 0; lane < REGULUS_LANES; ++lane) {
    const double sum = count * (count + 1.0) / 2 + double(count) * lane;
    EXPECT_EQ(out[lane], sum);
    EXPECT_EQ(out[REGULUS_LANES + lane], sum);
  }
}

TEST(FrameSlots, HoldAnyNumberOfValues) {
  for (const std::uint32_t count : {2U, 60U, 250U, 1000U, 4000U, 20000U}) expect_sum(count);
}

TEST(FrameSlots, AreOnesOwn) {
  for (const std::size_t count : {std::size_t{1}, std::size_t{300}, kMaxStackSlots + 1}) {
    const unsigned result = with_slots(count, [count](Slot* outer) {
      outer[count - 1].lanes[0] = 1;
      return with_slots(count, [&](Slot* inner) {
        inner[count - 1].lanes[0] = 2;
        return static_cast<unsigned>(outer[count - 1].lanes[0]);
      });
    });
    EXPECT_EQ(result, 1U);
  }
}

TEST(FrameSlots, LeaveNoLaneDefinedWithoutMemory) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "AddressSanitizer takes a refused allocation for a fault";
#endif
  const std::size_t too_many = std::size_t{1} << 55;
  EXPECT_EQ(with_slots(too_many, [](Slot*) { return 0U; }), 0xffU);
}

}  // namespace
}  // namespace regulus::detail::machine
