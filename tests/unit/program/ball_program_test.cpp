// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/program/ball_program.hpp"

// The threads of a search must hold no number of CLN: this header may not even declare one.
#if defined(_CL_OBJECT_H) || defined(_CL_NUMBER_H) || defined(_CL_RATIONAL_H) || \
    defined(GINAC_EX_H) || defined(GINAC_BASIC_H)
#error "codegen/kernel/program/ball_program.hpp includes CLN or GiNaC"
#endif

#include <cln/rational.h>
#include <cln/rational_io.h>
#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "codegen/kernel/program/arb_arithmetic.hpp"
#include "codegen/kernel/program/interpreter.hpp"

namespace regulus::detail {
namespace {

using cln::cl_RA;

const char* const kLong = "340282366920938463463374607431768211456/98765432109876543210987654321";

/// Uses constants of every size, π, every kind of operation; undefined for x ≤ 0.
Program example() {
  ProgramBuilder b({"x", "y"}, {});
  const NodeId x = b.input(0), y = b.input(1);
  const NodeId c = b.constant(cl_RA(kLong)), tiny = b.constant(cln::expt(cl_RA(10), -60));
  b.output(b.add(b.multiply(c, x), tiny));
  b.output(b.divide(b.subtract(y, b.constant(cl_RA("-7/3"))), b.call(Op::kSqrt, x)));
  b.output(b.atan2(b.power(y, 3), b.multiply(b.pi(), x)));
  b.output(b.call(Op::kSin, b.negate(b.call(Op::kLog, x))));
  return std::move(b).finish();
}

std::vector<Ball> point(double x, double y) { return {Ball(x), Ball(y)}; }

void expect_same(const Ball& a, const Ball& b) { EXPECT_TRUE(arb_equal(a.get(), b.get())); }

/// The ends of 1 ± 2^(−2^60) have more bits than a machine has memory.
TEST(Ball, WithATinyRadiusHasTheDoublesAroundItsMiddle) {
  for (const double middle : {1.0, -1.0, 0x1p-1074, 0.1}) {
    Ball ball(middle);
    mag_one(arb_radref(ball.get()));
    mag_mul_2exp_si(arb_radref(ball.get()), arb_radref(ball.get()), -(1L << 60));
    const Interval around = ball.enclosure();
    EXPECT_EQ(around.lo, std::nextafter(middle, -1e9) + 0.0);
    EXPECT_EQ(around.hi, std::nextafter(middle, 1e9));
  }
}

TEST(BallProgram, ComputesWhatTheProgramDoes) {
  const Program program = example();
  const BallProgram balls(program);
  EXPECT_TRUE(is_consistent(balls));
  for (const long bits : {53L, 106L, 1000L}) {
    ArbArithmetic arithmetic(bits);
    const std::vector<Ball> expected = evaluate<ArbArithmetic, Ball>(
        program, std::span<const Ball>(point(0.3, -2)), {}, arithmetic);
    const auto found = evaluate(balls, point(0.3, -2), bits);
    ASSERT_TRUE(found);
    ASSERT_EQ(found->size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) expect_same((*found)[i], expected[i]);
  }
  EXPECT_FALSE(evaluate(balls, point(-1, 0), 106));
  EXPECT_THROW(static_cast<void>(evaluate(balls, std::vector<Ball>(1), 106)),
               std::invalid_argument);
}

/// `make tsan` runs this, too: several threads that read the same numbers of CLN make a race.
TEST(BallProgram, MayBeEvaluatedByManyThreadsAtOnce) {
  const BallProgram balls(example());
  const auto expected = evaluate(balls, point(0.3, -2), 424);
  ASSERT_TRUE(expected);
  std::vector<int> differences(8, 0);
  std::vector<std::thread> threads;
  for (int& difference : differences)
    threads.emplace_back([&] {
      for (int i = 0; i < 200; ++i) {
        const auto found = evaluate(balls, point(0.3, -2), 424);
        for (std::size_t k = 0; k < expected->size(); ++k)
          if (!found || !arb_equal((*found)[k].get(), (*expected)[k].get())) ++difference;
      }
      flint_cleanup();
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(differences, std::vector<int>(8, 0));
}

TEST(BallProgram, IsInconsistentWithAnyIndexThatNamesNothing) {
  const BallProgram sound(example());
  const auto expect_inconsistent = [&](auto change) {
    BallProgram damaged = sound;
    change(damaged);
    EXPECT_FALSE(is_consistent(damaged));
  };
  for (std::size_t i = 0; i < sound.nodes.size(); ++i) {
    const Node& node = sound.nodes[i];
    const auto self = static_cast<NodeId>(i);
    if (operand_count(node.op) > 0) expect_inconsistent([&](auto& p) { p.nodes[i].a = self; });
    if (operand_count(node.op) > 1) expect_inconsistent([&](auto& p) { p.nodes[i].b = self + 1; });
    if (node.op == Op::kConstant || node.op == Op::kInput)
      expect_inconsistent([&](auto& p) { p.nodes[i].index = 1000; });
    expect_inconsistent([&](auto& p) { p.nodes[i].op = Op(static_cast<int>(Op::kAbs) + 1); });
    expect_inconsistent([&](auto& p) { p.nodes[i].op = Op::kPoint; });
  }
  expect_inconsistent([](auto& p) { p.outputs[0] = NodeId(p.nodes.size()); });
}

TEST(FlintRational, IsReadBackFromItsTextAndFromNoOther) {
  for (const char* text : {"0", "1", "-5/3", kLong, "-1000000000000000000000000"}) {
    const FlintRational value{cl_RA(text)};
    EXPECT_EQ(value.text(), text);
    const auto read = FlintRational::read(text);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->text(), text);
  }
  for (const char* text : {"", "/", "1/", "/3", "2/4", "1/0", "0/0", "0/1", "-0", "+1", " 1", "1 ",
                           "1/-3", "01", "0x1", "1.5", "1/2/3", "nan"})
    EXPECT_FALSE(FlintRational::read(text)) << text;
}

}  // namespace
}  // namespace regulus::detail
