// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors that are turned and moved by unknowns: the sums have the values of rotations in doubles.
#include "runtime/verifier/trig_sums.hpp"

#include <gtest/gtest.h>

#include <array>

#include "runtime/verifier/evaluation.hpp"
#include "tests/support/random_source.hpp"
#include "tests/support/serial/forward_kinematics.hpp"

namespace regulus::verifier {
namespace {

using detail::test::RandomSource;
using detail::test::Vec;

struct Axis {
  std::array<long, 3> numbers;
  long length;
};
constexpr std::array<Axis, 5> kAxes = {
    {{{0, 0, 1}, 1}, {{0, -1, 0}, 1}, {{1, 2, 2}, 3}, {{2, -1, 2}, 3}, {{0, 3, 4}, 5}}};

class Sums {
 public:
  static constexpr std::size_t kUnknowns = 3;

  Sums() : sums_(graph_, kUnknowns) {
    for (std::size_t k = 0; k < kUnknowns; ++k)
      unknowns_.push_back(graph_.add(Op::kVariable, int(k)));
  }

  NodeId number(long numerator, long denominator = 1) {
    return graph_.number(Rational(numerator) / Rational(denominator));
  }
  VectorNodes vector(const Axis& axis) {
    return {number(axis.numbers[0], axis.length), number(axis.numbers[1], axis.length),
            number(axis.numbers[2], axis.length)};
  }
  static Vec in_doubles(const Axis& axis) {
    return {double(axis.numbers[0]) / double(axis.length),
            double(axis.numbers[1]) / double(axis.length),
            double(axis.numbers[2]) / double(axis.length)};
  }

  double value(NodeId node, const std::array<double, kUnknowns>& at) {
    std::vector<Ball> balls;
    for (const double x : at) balls.emplace_back(point(x), 128);
    const auto values = evaluate(graph_, {node}, balls, 128);
    EXPECT_TRUE(values);
    return values ? mid((*values)[0].enclosure()) : 0;
  }

  Graph graph_;
  TrigSums sums_;
  std::vector<NodeId> unknowns_;
};

TEST(SumsOfWaves, AreTheVectorsThatAreTurnedAndMoved) {
  using detail::test::operator+, detail::test::operator*;
  RandomSource random(5);
  for (int round = 0; round < 60; ++round) {
    Sums s;
    const std::array<double, 3> at = {random.between(-3, 3), random.between(-3, 3),
                                      random.between(-3, 3)};
    const Axis& first = kAxes[random.below(5)];
    TrigVector x = s.sums_.constant(s.vector(first));
    Vec expected = Sums::in_doubles(first);
    for (int step = 0; step < 5; ++step) {
      const Axis& axis = kAxes[random.below(5)];
      const std::size_t unknown = random.below(Sums::kUnknowns);
      const std::array<long, 5> multipliers = {1, -1, 2, -3, 1};
      const std::size_t kind = random.below(6);
      NodeId frequency = s.number(multipliers[kind % 5], kind == 4 ? 2 : 1);
      double multiple = double(multipliers[kind % 5]) / (kind == 4 ? 2 : 1);
      if (kind == 5) frequency = s.graph_.add(Op::kSqrt, s.number(2)), multiple = std::sqrt(2.0);
      const Vec a = Sums::in_doubles(axis);
      if (random.one_in(4)) {  // moved by a multiple of the unknown
        x = s.sums_.sum(
            x, s.sums_.scaled(frequency,
                              s.sums_.times_unknown(s.sums_.constant(s.vector(axis)), unknown)));
        expected = expected + (multiple * at[unknown]) * a;
        continue;
      }
      const long sign = random.one_in(2) ? 1 : -1;
      x = s.sums_.turned(x, s.vector(axis), unknown, frequency, sign);
      expected = detail::test::turn_about(a, double(sign) * multiple * at[unknown]) * expected;
    }
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(s.value(s.sums_.expression(x[i], s.unknowns_), at), expected[i], 1e-11) << round;
  }
}

/// What turns and is turned back is as it was, term by term.
TEST(SumsOfWaves, AreConstantWhereAFollowerTurnsBack) {
  Sums s;
  for (const Axis& axis : kAxes) {
    const VectorNodes start = s.vector(kAxes[3]);
    TrigVector x = s.sums_.turned(s.sums_.constant(start), s.vector(axis), 1, s.number(-1, 3), 1);
    x = s.sums_.turned(x, s.vector(axis), 1, s.number(-1, 3), -1);
    for (std::size_t i = 0; i < 3; ++i) {
      const TrigSum gap = s.sums_.sum(x[i], s.sums_.constant(start)[i], -1);
      EXPECT_TRUE(gap.empty()) << i;
    }
  }
}

}  // namespace
}  // namespace regulus::verifier
