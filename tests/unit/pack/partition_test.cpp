// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/pack/partition.hpp"

#include <gtest/gtest.h>

#include <map>

#include "tests/support/random_program.hpp"

namespace regulus::detail {
namespace {

using Kind = Step::Kind;

Program random_long_program(std::uint64_t seed) {
  test::RandomSource random(seed);
  test::ProgramShape shape;
  shape.operations = 120;
  shape.outputs = 12;
  return test::random_program<ProgramBuilder>(random, shape);
}

TEST(FunctionPlan, CutsFunctionsIntoPartsThatHoldTogether) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Program program = random_long_program(seed);
    const FunctionPlan plan = plan_function(program, 10);
    std::size_t next = 0;
    for (const Part& part : plan.parts) {
      ASSERT_EQ(part.first_step, next);
      ASSERT_LE(part.last_step - part.first_step, 10U);
      ASSERT_GT(part.last_step, part.first_step);
      next = part.last_step;
    }
    ASSERT_EQ(next, plan.steps.size());
  }
}

/// Replays the plan: each read of a slot must find the value that was stored there.
TEST(FunctionPlan, NeverReusesASlotThatIsStillNeeded) {
  int read = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Program program = random_long_program(seed);
    const FunctionPlan plan = plan_function(program, 7);
    std::map<int, NodeId> slots;
    for (std::uint32_t p = 0; p < plan.parts.size(); ++p)
      for (std::size_t i = plan.parts[p].first_step; i < plan.parts[p].last_step; ++i) {
        const Step& step = plan.steps[i];
        const Node& node = program.nodes[step.node];
        const auto expect_at_hand = [&](NodeId id) {
          if (plan.leaves[id] || plan.part_of[id] == p) return;
          ASSERT_LT(plan.slots[id], plan.slot_count);
          ASSERT_EQ(slots.at(plan.slots[id]), id) << "seed " << seed;
          ++read;
        };
        if (step.kind == Kind::kStore) {
          expect_at_hand(step.node);
          continue;
        }
        if (operand_count(node.op) >= 1) expect_at_hand(node.a);
        if (operand_count(node.op) == 2) expect_at_hand(node.b);
        if (plan.slots[step.node] != kNoSlot) slots[plan.slots[step.node]] = step.node;
      }
  }
  EXPECT_GT(read, 1000);
}

TEST(FunctionPlan, StoresEveryOutputOnce) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Program program = random_long_program(seed);
    const FunctionPlan plan = plan_function(program, 9);
    std::vector<int> stored(program.outputs.size(), 0);
    for (const Step& step : plan.steps)
      for (std::size_t e = step.first_output; step.kind == Kind::kStore && e <= step.last_output;
           ++e) {
        ++stored[e];
        ASSERT_EQ(program.outputs[e], step.node);
      }
    ASSERT_EQ(stored, std::vector<int>(program.outputs.size(), 1));
  }
}

TEST(FunctionPlan, StoresARunOfZerosAtOnce) {
  ProgramBuilder b({"x"}, {});
  b.output(b.input(0));
  for (int i = 0; i < 30; ++i) b.output(b.constant(0));
  const FunctionPlan plan = plan_function(std::move(b).finish(), 200);
  ASSERT_EQ(plan.steps.size(), 2U);
  EXPECT_EQ(plan.steps[1].first_output, 1U);
  EXPECT_EQ(plan.steps[1].last_output, 30U);
}

TEST(FunctionPlan, ComputesNothingThatIsConstant) {
  ProgramBuilder b({"x"}, {});
  b.output(b.multiply(b.call(Op::kSin, b.divide(b.pi(), b.constant(180))), b.input(0)));
  EXPECT_EQ(plan_function(std::move(b).finish(), 200).operations, 1U);
}

TEST(FunctionPlan, ComputesConstantsThatMayBeUndefined) {
  ProgramBuilder b({"x"}, {});
  b.output(b.call(Op::kSqrt, b.subtract(b.constant(-1), b.pi())));
  EXPECT_EQ(plan_function(std::move(b).finish(), 200).operations, 1U);
}

TEST(FunctionPlan, TakesEntriesOfKAsPoints) {
  ProgramBuilder b({"x"}, {"k"});
  b.output(b.add(b.negate(b.point(0)), b.input(0)));
  const Program program = std::move(b).finish();
  const FunctionPlan plan = plan_function(program, 200);
  EXPECT_EQ(plan.operations, 1U);
}

}  // namespace
}  // namespace regulus::detail
