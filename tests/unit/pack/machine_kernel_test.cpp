// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/machine/machine_kernel.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "codegen/kernel/pack/select.hpp"
#include "codegen/kernel/program/print.hpp"
#include "runtime/interval/interval.hpp"
#include "runtime/kernel/buffers.hpp"
#include "runtime/kernel/call.hpp"

namespace regulus::detail {
namespace {

using machine::MachineKernel;

/// Makes A = [sqrt(x)·y], K·A = [k·sqrt(x)·y], and one constraint x^40.
Module example() {
  Module module;
  module.model = "example";
  module.variables = {"x", "y"};
  module.motion_variables = 1;
  module.rows = module.columns = 1;
  module.constraints = 1;
  const auto add = [&](const char* name, std::vector<std::string> points, auto expression) {
    ProgramBuilder builder(module.variables, std::move(points));
    builder.output(expression(builder));
    module.functions.push_back({name, "", std::move(builder).finish(), 1, 1, {}});
  };
  const auto entry = [](auto& b) { return b.multiply(b.call(Op::kSqrt, b.input(0)), b.input(1)); };
  add("matrix", {}, entry);
  add("left_product", {"k_1_1"}, [&](auto& b) { return b.multiply(b.point(0), entry(b)); });
  add("constraint", {}, [](auto& b) { return b.power(b.input(0), 40); });
  return module;
}

MachineKernel machine_of(const Module& module) { return {select(module), best_isa()}; }

TEST(MachineKernelOfAModule, FillsTheTableOfTheAbi) {
  const Module module = example();
  const MachineKernel kernel = machine_of(module);
  const regulus_kernel& k = *kernel.get();
  EXPECT_EQ(k.abi, static_cast<unsigned>(REGULUS_KERNEL_ABI));
  EXPECT_EQ(k.rounding, required_rounding(best_isa()));
  EXPECT_EQ(k.variables, 2U);
  EXPECT_EQ(k.motion_variables, 1U);
  EXPECT_EQ(k.rows, 1U);
  EXPECT_EQ(k.constraints, 1U);
  EXPECT_NE(k.matrix, nullptr);
  EXPECT_EQ(k.right_product, nullptr);
  EXPECT_EQ(k.pose, nullptr);
  EXPECT_EQ(k.identity, identity(module));
}

TEST(MachineKernelOfAModule, EvaluatesEachLaneOnItsOwn) {
  const MachineKernel interpreted = machine_of(example());
  const CheckedKernel kernel(*interpreted.get());
  BoxBatch boxes(2);
  PointRows points(1);
  OutputBatch out(1);
  for (std::size_t lane = 0; lane < REGULUS_LANES; ++lane) {
    const double side = static_cast<double>(lane);
    boxes.set(0, lane, {side * side, (side + 1) * (side + 1)});
    boxes.set(1, lane, {2, 3});
    points.set(0, lane, -1 - side);
  }
  EXPECT_EQ(kernel.call(kernel.functions().left_product, boxes.data(), points.data(), out.data()),
            0U);
  for (std::size_t lane = 0; lane < REGULUS_LANES; ++lane) {
    const double side = static_cast<double>(lane);
    EXPECT_EQ(out.get(0, lane), Interval(-(1 + side) * (side + 1) * 3, -(1 + side) * side * 2));
  }
}

TEST(MachineKernelOfAModule, ReportsTheLanesOutsideTheDomain) {
  const MachineKernel interpreted = machine_of(example());
  const CheckedKernel kernel(*interpreted.get());
  BoxBatch boxes(2);
  OutputBatch out(1);
  boxes.set_all_lanes(1, {1, 1});
  boxes.set(0, 3, {-1e-300, 1});
  boxes.set(0, 5, {-2, -1});
  EXPECT_EQ(kernel.call(kernel.functions().matrix, boxes.data(), nullptr, out.data()), 0b101000U);
}

TEST(MachineKernelOfAModule, ReportsLanesWithoutFiniteBounds) {
  const MachineKernel interpreted = machine_of(example());
  const CheckedKernel kernel(*interpreted.get());
  BoxBatch boxes(2);
  OutputBatch out(1);
  boxes.set(0, 0, {0, 0x1p60});
  boxes.set(0, 7, {0, 0x1p20});
  EXPECT_EQ(kernel.call(kernel.functions().constraint, boxes.data(), nullptr, out.data()), 1U);
}

TEST(MachineKernelOfAModule, CountsQuotientsBeyondTheLimitAsUndefined) {
  Module module = example();
  ProgramBuilder builder(module.variables, {});
  builder.output(builder.divide(builder.constant(1), builder.input(0)));
  module.functions[2].program = std::move(builder).finish();
  const MachineKernel interpreted = machine_of(module);
  const CheckedKernel kernel(*interpreted.get());
  BoxBatch boxes(2);
  OutputBatch out(1);
  boxes.set_all_lanes(0, {0x1p-128, 1});
  boxes.set(0, 2, {0x1p-129, 1});
  EXPECT_EQ(kernel.call(kernel.functions().constraint, boxes.data(), nullptr, out.data()), 0b100U);
}

TEST(MachineKernelOfAModule, SurvivesBeingMoved) {
  MachineKernel first = machine_of(example());
  const regulus_kernel* before = first.get();
  const MachineKernel second(std::move(first));
  EXPECT_EQ(second.get(), before);
}

TEST(MachineKernelOfAModule, GivesEveryThreadTheSameAnswer) {
  const MachineKernel interpreted = machine_of(example());
  const CheckedKernel kernel(*interpreted.get());
  BoxBatch boxes(2);
  boxes.set_all_lanes(0, {2, 3});
  boxes.set_all_lanes(1, {-1, 7});
  OutputBatch expected(1);
  EXPECT_EQ(kernel.call(kernel.functions().matrix, boxes.data(), nullptr, expected.data()), 0U);
  std::vector<int> differences(4, 0);
  std::vector<std::thread> threads;
  for (int& difference : differences)
    threads.emplace_back([&] {
      OutputBatch out(1);
      for (int i = 0; i < 2000; ++i) {
        if (kernel.call(kernel.functions().matrix, boxes.data(), nullptr, out.data()) != 0 ||
            out.get(0, 4) != expected.get(0, 4))
          ++difference;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(differences, std::vector<int>(4, 0));
}

}  // namespace
}  // namespace regulus::detail
