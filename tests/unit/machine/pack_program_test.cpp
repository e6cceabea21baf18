// SPDX-License-Identifier: GPL-3.0-or-later
// Faults of a foreign list of operations are reported before it runs.
#include "runtime/machine/pack_program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>

#include "runtime/kernel/buffers.hpp"
#include "runtime/kernel/call.hpp"
#include "runtime/machine/machine_kernel.hpp"

namespace regulus::detail::machine::pack_program {
namespace {

using Op = PackOperation;
using testing::HasSubstr;

/// Makes two parts: out[0] = x·y + 3, using a kept product; out[1] and out[2] = sin x.
PackFunction sample() {
  PackFunction f;
  f.code = {{Op::kLoad, 0},     {Op::kLoad, 1},      {Op::kMultiply_II, 0, 1}, {Op::kKeep, 0, 2},
            {Op::kSinCos_I, 0}, {Op::kCosine, 4},    {Op::kStore, 1, 2, 4},    {Op::kFetch, 0},
            {Op::kExact, 0},    {Op::kAdd_IP, 7, 8}, {Op::kStore, 0, 0, 9}};
  f.part_ends = {7, 11};
  f.constants = {Interval(3.0)};
  f.slots = 1;
  f.outputs = 3;
  return f;
}

std::string fault_after(const std::function<void(PackFunction&)>& damage) {
  PackFunction f = sample();
  damage(f);
  return find_fault(f, 2, 0);
}

TEST(PackProgram, HasNoFaultAsItIsMade) { EXPECT_EQ(find_fault(sample(), 2, 0), ""); }

TEST(PackProgram, ReadsNoValueOfALaterInstruction) {
  EXPECT_THAT(fault_after([](PackFunction& f) { f.code[2].b = 2; }), HasSubstr("instruction 2"));
  EXPECT_THAT(fault_after([](PackFunction& f) { f.code[2].a = 400; }), HasSubstr("instruction 2"));
}

TEST(PackProgram, ReadsNoValueOfAnotherPart) {
  EXPECT_THAT(fault_after([](PackFunction& f) { f.code[9].a = 2; }), HasSubstr("instruction 9"));
}

TEST(PackProgram, ReadsNoValueOfAnotherKind) {
  EXPECT_THAT(fault_after([](PackFunction& f) {
                f.code[9] = {Op::kAdd_II, 7, 8};
              }),
              HasSubstr("of that kind"));
  EXPECT_THAT(fault_after([](PackFunction& f) { f.code[3].b = 3; }), HasSubstr("instruction 3"));
}

TEST(PackProgram, NamesNothingBeyondItsSizes) {
  EXPECT_THAT(fault_after([](PackFunction& f) { f.code[1].a = 2; }), HasSubstr("no variable"));
  EXPECT_THAT(fault_after([](PackFunction& f) { f.code[1] = {Op::kPoint, 0}; }), HasSubstr("of K"));
  EXPECT_THAT(fault_after([](PackFunction& f) { f.code[8].a = 1; }), HasSubstr("constant"));
  EXPECT_THAT(fault_after([](PackFunction& f) { f.code[6].b = 3; }), HasSubstr("no output"));
  EXPECT_THAT(fault_after([](PackFunction& f) { f.code[3].a = 1; }), HasSubstr("keeps"));
  EXPECT_THAT(fault_after([](PackFunction& f) { f.part_ends[0] = 12; }), HasSubstr("part"));
  EXPECT_THAT(fault_after([](PackFunction& f) { f.part_ends.pop_back(); }), HasSubstr("part"));
}

TEST(PackProgram, UsesNoSlotThatIsEmptyOrStillRead) {
  EXPECT_THAT(fault_after([](PackFunction& f) {
                f.code[3] = {Op::kAbs_I, 2};
              }),
              HasSubstr("not kept"));
  EXPECT_THAT(fault_after([](PackFunction& f) {
                f.code.insert(f.code.begin() + 9, {Op::kKeep, 0, 7});
                f.code[10] = {Op::kAdd_IP, 7, 8};
                f.code[11] = {Op::kStore, 0, 0, 10};
                f.part_ends[1] = 12;
              }),
              HasSubstr("still read"));
}

TEST(PackProgram, HasBothOfAPairAndEveryOutput) {
  EXPECT_THAT(fault_after([](PackFunction& f) {
                f.code[5] = {Op::kAbs_I, 4};
              }),
              HasSubstr("no cosine"));
  EXPECT_THAT(fault_after([](PackFunction& f) {
                f.code[4] = {Op::kSin_I, 0};
              }),
              HasSubstr("no pair"));
  EXPECT_THAT(fault_after([](PackFunction& f) { f.code[6].b = 1; }), HasSubstr("output"));
}

TEST(PackProgram, StoresNoOutputAgain) {
  EXPECT_THAT(fault_after([](PackFunction& f) { f.code[10].b = 1; }), HasSubstr("again"));
}

TEST(PackProgram, HasConstantsInOrder) {
  EXPECT_THAT(fault_after([](PackFunction& f) { f.constants[0].hi = 2; }), HasSubstr("constant"));
  EXPECT_THAT(fault_after([](PackFunction& f) {
                f.constants[0] = {__builtin_nan(""), __builtin_nan("")};
              }),
              HasSubstr("constant"));
}

PackKernel kernel_of(PackFunction matrix) {
  PackKernel kernel;
  kernel.variables = kernel.motion_variables = 2;
  kernel.rows = 3;
  kernel.columns = 1;
  kernel.functions[0] = std::move(matrix);
  kernel.identity = "a list";
  return kernel;
}

TEST(MachineKernel, RunsAListOnEveryInstructionSet) {
  for (const Isa isa : kAllIsas) {
    if (!supported(isa)) continue;
    const MachineKernel machine(kernel_of(sample()), isa);
    const CheckedKernel kernel(*machine.get());
    BoxBatch boxes(2);
    OutputBatch out(3);
    for (std::size_t lane = 0; lane < REGULUS_LANES; ++lane) {
      boxes.set(0, lane, Interval(static_cast<double>(lane)));
      boxes.set(1, lane, {-1.0, 2.0});
    }
    EXPECT_EQ(kernel.call(kernel.functions().matrix, boxes.data(), nullptr, out.data()), 0U);
    for (std::size_t lane = 0; lane < REGULUS_LANES; ++lane) {
      const double x = static_cast<double>(lane);
      EXPECT_TRUE(certain_subset(Interval(3 - x, 3 + 2 * x), out.get(0, lane)));
      EXPECT_NEAR(out.get(0, lane).lo, 3 - x, 1e-14);
      EXPECT_NEAR(out.get(0, lane).hi, 3 + 2 * x, 1e-14);
      EXPECT_EQ(out.get(1, lane), out.get(2, lane));
    }
    EXPECT_TRUE(certain_subset(Interval(0.0), out.get(1, 0)));
  }
}

TEST(MachineKernel, RefusesAListThatIsFaulty) {
  PackFunction f = sample();
  f.code[1].a = 2;
  EXPECT_THROW(MachineKernel(kernel_of(f), Isa::kPortable), std::invalid_argument);
}

}  // namespace
}  // namespace regulus::detail::machine::pack_program
