// SPDX-License-Identifier: GPL-3.0-or-later
// Compares folding with the same expressions built without folding, at exact points.
#include <gtest/gtest.h>

#include <optional>

#include "codegen/kernel/program/interpreter.hpp"
#include "codegen/kernel/program/rational_arithmetic.hpp"
#include "tests/support/random_program.hpp"

namespace regulus::detail::test {
namespace {

using Values = std::vector<cln::cl_RA>;

enum class Outcome { kValues, kUndefined, kNotRational };

struct Evaluation {
  Outcome outcome;
  Values values;
};

Evaluation evaluate_at(const Program& program, const Values& inputs, const Values& points) {
  RationalArithmetic arithmetic;
  try {
    return {Outcome::kValues, evaluate(program, std::span(inputs), std::span(points), arithmetic)};
  } catch (const UndefinedValue&) {
    return {Outcome::kUndefined, {}};
  } catch (const NotRational&) {
    return {Outcome::kNotRational, {}};
  }
}

/// Returns perfect squares, signs and zeros: roots of these are rational, or domains end there.
Values corner_values(RandomSource& random, int count) {
  Values values;
  for (int i = 0; i < count; ++i) {
    const long small = static_cast<long>(random.below(5)) - 2;
    values.push_back(random.one_in(3) ? cln::cl_RA(small * small) : cln::cl_RA(small) / 2);
  }
  return values;
}

TEST(Folding, KeepsTheValueAndTheDomainOfRandomExpressions) {
  int defined = 0;
  int undefined = 0;
  for (std::uint64_t seed = 0; seed < 60000; ++seed) {
    ProgramShape shape;
    shape.operations = 3 + static_cast<int>(seed % 8);
    shape.outputs = 1;
    shape.largest_power = 3;
    RandomSource first(seed);
    RandomSource second(seed);
    const Program raw = random_program<RawBuilder>(first, shape);
    const Program folded = random_program<ProgramBuilder>(second, shape);
    for (int sample = 0; sample < 3; ++sample) {
      const Values inputs = corner_values(first, shape.inputs);
      const Values points = corner_values(first, shape.points);
      const Evaluation expected = evaluate_at(raw, inputs, points);
      const Evaluation found = evaluate_at(folded, inputs, points);
      if (expected.outcome == Outcome::kValues) {
        ASSERT_EQ(found.outcome, Outcome::kValues) << "seed " << seed;
        ASSERT_EQ(found.values[0], expected.values[0]) << "seed " << seed;
        ++defined;
      } else if (expected.outcome == Outcome::kUndefined) {
        ASSERT_NE(found.outcome, Outcome::kValues) << "seed " << seed;
        ++undefined;
      }
    }
  }
  EXPECT_GT(defined, 30000);
  EXPECT_GT(undefined, 10000);
}

TEST(Folding, NeverMakesAProgramLonger) {
  for (std::uint64_t seed = 0; seed < 5000; ++seed) {
    RandomSource first(seed);
    RandomSource second(seed);
    const Program raw = random_program<RawBuilder>(first, {});
    const Program folded = random_program<ProgramBuilder>(second, {});
    // If a sign moves outwards, each use that had shared a node may need a node of its own.
    ASSERT_LE(folded.nodes.size(), raw.nodes.size() + 4) << "seed " << seed;
  }
}

}  // namespace
}  // namespace regulus::detail::test
