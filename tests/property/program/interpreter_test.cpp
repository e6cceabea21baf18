// SPDX-License-Identifier: GPL-3.0-or-later
// Compares intervals with exact rationals and with Arb, on random programs over random boxes.
#include "codegen/kernel/program/interpreter.hpp"

#include <gtest/gtest.h>

#include "codegen/kernel/program/arb_arithmetic.hpp"
#include "codegen/kernel/program/enclose.hpp"
#include "codegen/kernel/program/interval_arithmetic.hpp"
#include "codegen/kernel/program/print.hpp"
#include "codegen/kernel/program/rational_arithmetic.hpp"
#include "codegen/kernel/program/rational_bounds.hpp"
#include "tests/support/ball_containment.hpp"
#include "tests/support/random_program.hpp"

namespace regulus::detail::test {
namespace {

struct Box {
  std::vector<Interval> inputs;
  std::vector<double> points;
};

Box random_box(RandomSource& random, const ProgramShape& shape, int largest_exponent) {
  Box box;
  for (int i = 0; i < shape.inputs; ++i)
    box.inputs.push_back(corner_interval(random, largest_exponent));
  for (int i = 0; i < shape.points; ++i)
    box.points.push_back(corner_double(random, largest_exponent));
  return box;
}

template <class Number>
std::vector<Number> convert(const std::vector<double>& values) {
  std::vector<Number> result;
  for (const double value : values) result.push_back(Number(value));
  return result;
}

std::vector<double> random_point(RandomSource& random, const Box& box) {
  std::vector<double> point;
  for (const Interval& x : box.inputs) point.push_back(point_of(random, x));
  return point;
}

struct IntervalResult {
  bool undefined;
  std::vector<Interval> outputs;
};

IntervalResult evaluate_box(const Program& program, const Box& box) {
  IntervalArithmetic arithmetic;
  const std::vector<Interval> points = convert<Interval>(box.points);
  auto outputs = evaluate(program, std::span<const Interval>(box.inputs),
                          std::span<const Interval>(points), arithmetic);
  return {arithmetic.undefined(), std::move(outputs)};
}

struct BallResult {
  bool defined;
  bool certainly_undefined;
  std::vector<Ball> outputs;
};

BallResult evaluate_point(const Program& program, const std::vector<double>& inputs,
                          const std::vector<double>& points, long precision) {
  ArbArithmetic arithmetic(precision);
  const std::vector<Ball> in = convert<Ball>(inputs);
  const std::vector<Ball> k = convert<Ball>(points);
  auto outputs = evaluate(program, std::span(in), std::span(k), arithmetic);
  return {!arithmetic.undefined(), arithmetic.certainly_undefined(), std::move(outputs)};
}

TEST(Interpreter, EnclosesArbAtPointsOfTheBox) {
  constexpr long kPrecision = 256;
  long contained = 0;
  long undefined = 0;
  for (std::uint64_t seed = 0; seed < 100000; ++seed) {
    RandomSource random(seed);
    ProgramShape shape;
    shape.operations = 2 + static_cast<int>(random.below(14));
    shape.tree_like = seed % 2 == 0;
    const Program program = random_program<ProgramBuilder>(random, shape);
    const Box box = random_box(random, shape, seed % 4 == 0 ? 64 : 4);
    const IntervalResult found = evaluate_box(program, box);
    const BallResult exact =
        evaluate_point(program, random_point(random, box), box.points, kPrecision);
    if (exact.certainly_undefined) {
      ASSERT_TRUE(found.undefined) << "seed " << seed << "\n" << to_text(program);
      ++undefined;
    }
    if (!exact.defined || found.undefined) continue;
    for (std::size_t e = 0; e < found.outputs.size(); ++e) {
      ASSERT_TRUE(possibly_contains(found.outputs[e], exact.outputs[e]))
          << "seed " << seed << " output " << e << "\n"
          << to_text(program);
      ++contained;
    }
  }
  EXPECT_GT(contained, 50000);
  EXPECT_GT(undefined, 5000);
}

TEST(Interpreter, EnclosesExactRationalsAndBallsDoToo) {
  long compared = 0;
  for (std::uint64_t seed = 0; seed < 100000; ++seed) {
    RandomSource random(seed);
    ProgramShape shape;
    shape.operations = 2 + static_cast<int>(random.below(7));
    shape.outputs = 1;
    shape.functions = false;
    shape.largest_power = 3;
    const Program program = random_program<ProgramBuilder>(random, shape);
    const Box box = random_box(random, shape, 64);
    const std::vector<double> point = random_point(random, box);
    std::vector<cln::cl_RA> inputs, points;
    for (const double x : point) inputs.push_back(exact_rational(x));
    for (const double x : box.points) points.push_back(exact_rational(x));
    const IntervalResult found = evaluate_box(program, box);
    const BallResult ball = evaluate_point(program, point, box.points, 64);
    RationalArithmetic arithmetic;
    try {
      const cln::cl_RA value = evaluate(program, std::span<const cln::cl_RA>(inputs),
                                        std::span<const cln::cl_RA>(points), arithmetic)[0];
      ASSERT_TRUE(found.undefined || contains_exactly(found.outputs[0], value)) << "seed " << seed;
      ASSERT_TRUE(!ball.defined || contains_exactly(ball.outputs[0].enclosure(), value))
          << "seed " << seed;
      ASSERT_FALSE(ball.certainly_undefined) << "seed " << seed;
      ++compared;
    } catch (const UndefinedValue&) {
      ASSERT_TRUE(found.undefined) << "seed " << seed;
      ASSERT_FALSE(ball.defined) << "seed " << seed;
    }
  }
  EXPECT_GT(compared, 80000);
}

TEST(Interpreter, EnclosesConstantsWithinAStepOfArb) {
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    RandomSource random(seed);
    ProgramShape shape;
    shape.inputs = shape.points = 0;
    shape.operations = 1 + static_cast<int>(random.below(8));
    shape.outputs = 1;
    const Program program = random_program<ProgramBuilder>(random, shape);
    const auto found = enclose(program);
    const BallResult exact = evaluate_point(program, {}, {}, 4096);
    ASSERT_EQ(exact.certainly_undefined && found.has_value(), false) << "seed " << seed;
    if (!found || !exact.defined) continue;
    const Interval best = exact.outputs[0].enclosure();
    ASSERT_TRUE(possibly_contains(*found, exact.outputs[0])) << to_text(program);
    if (mag(best) < 1e-300 || !is_bounded(best)) continue;
    ASSERT_LE(std::nextafter(best.lo, -kInfinity), found->lo) << to_text(program);
    ASSERT_GE(std::nextafter(best.hi, kInfinity), found->hi) << to_text(program);
  }
}

}  // namespace
}  // namespace regulus::detail::test
