// SPDX-License-Identifier: GPL-3.0-or-later
// Merlet, T-RO 2007: the example of §II-A (x² − 2x over [3, 5]) and the two forms of an entry of
// the conditioned matrix in §III-B1.
#include <gtest/gtest.h>

#include <span>
#include <vector>

#include "codegen/kernel/formulation/formulation.hpp"
#include "codegen/kernel/program/interpreter.hpp"
#include "codegen/kernel/program/interval_arithmetic.hpp"
#include "codegen/kernel/symbolic/lowering.hpp"
#include "codegen/kernel/symbolic/print.hpp"
#include "codegen/kernel/symbolic/rewrite.hpp"

namespace regulus::detail {
namespace {

Interval enclosure(const Expression& e, const std::vector<std::string>& variables,
                   const std::vector<Interval>& box, const std::vector<std::string>& points = {},
                   const std::vector<Interval>& k = {}) {
  Lowering lowering(variables, points);
  lowering.output(e);
  IntervalArithmetic arithmetic;
  return evaluate<IntervalArithmetic>(std::move(lowering).finish(), std::span<const Interval>(box),
                                      std::span<const Interval>(k), arithmetic)[0];
}

class Parabola : public ::testing::Test {
 protected:
  const Expression x = variable("x");
  const Expression natural = power(x, 2) - Expression(2) * x;
  const std::vector<Interval> box = {{3, 5}};
};

TEST_F(Parabola, AsWrittenIsFrom3MinusTo19) {
  EXPECT_EQ(enclosure(natural, {"x"}, box), Interval(-1, 19));
}

TEST_F(Parabola, InHornersFormIsExact) {
  Rewriter rewriter({"x"}, {});
  const Expression nested =
      horner(rewriter.expand(natural), rewriter.atoms(), {HornerOrder::kMostFrequent, true, false});
  EXPECT_EQ(to_string(nested), "x*(x - 2)");
  EXPECT_EQ(enclosure(nested, {"x"}, box), Interval(3, 15));
}

TEST_F(Parabola, RewritingFindsTheSquareWithOneOccurrence) {
  Rewriter rewriter({"x"}, {});
  const Rewritten form = rewriter.rewrite(natural);
  EXPECT_EQ(to_string(form.expression), "(x - 1)^2 - 1");
  EXPECT_EQ(total(count_occurrences(form.expression)), 1u);
  EXPECT_EQ(enclosure(form.expression, {"x"}, box), Interval(3, 15));
}

/// Σ k_1j (x + A_j) with the first row of K equal to (1, −1, 1, −1, 2, −1), x in [−1, 1] and every
/// A_j in [−0.5, 0.5].
class ConditionedEntry : public ::testing::Test {
 protected:
  ConditionedEntry() {
    Expressions terms;
    for (int j = 1; j <= 6; ++j) {
      const std::string anchor = std::string("A").append(std::to_string(j));
      variables.push_back(anchor);
      box.push_back({-0.5, 0.5});
      points.push_back(point_name(1, j));
      terms.push_back(point(points.back()) * (variable("x") + variable(anchor)));
    }
    form_1 = sum(terms);
  }
  std::vector<std::string> variables = {"x"};
  std::vector<Interval> box = {{-1, 1}};
  std::vector<std::string> points;
  const std::vector<Interval> k = {1, -1, 1, -1, 2, -1};
  Expression form_1;
};

TEST_F(ConditionedEntry, Form1HasSixOccurrencesOfX) {
  EXPECT_EQ(count_occurrences(form_1).at("x"), 6u);
  EXPECT_EQ(enclosure(form_1, variables, box, points, k), Interval(-10.5, 10.5));
}

TEST_F(ConditionedEntry, RewritingGivesForm2WithOneOccurrenceOfX) {
  Rewriter rewriter(variables, points);
  const Rewritten form = rewriter.rewrite(form_1);
  EXPECT_EQ(count_occurrences(form.expression).at("x"), 1u);
  EXPECT_EQ(enclosure(form.expression, variables, box, points, k), Interval(-4.5, 4.5));
}

}  // namespace
}  // namespace regulus::detail
