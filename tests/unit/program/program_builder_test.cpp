// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <climits>
#include <functional>
#include <stdexcept>

#include "codegen/kernel/program/print.hpp"
#include "codegen/kernel/program/program.hpp"

namespace regulus::detail {
namespace {

using Expression = std::function<NodeId(ProgramBuilder&)>;

/// Returns the nodes of a program with one output, without its declarations.
std::string nodes_of(const Expression& expression) {
  ProgramBuilder builder({"x", "y"}, {"k"});
  builder.output(expression(builder));
  const std::string text = to_text(std::move(builder).finish());
  return text.substr(text.find('%'));
}

NodeId x(ProgramBuilder& b) { return b.input(0); }
NodeId y(ProgramBuilder& b) { return b.input(1); }
NodeId root(ProgramBuilder& b) { return b.call(Op::kSqrt, b.input(0)); }

void expect_same(const Expression& left, const Expression& right) {
  EXPECT_EQ(nodes_of(left), nodes_of(right));
}

TEST(ProgramBuilder, FoldsNeutralElements) {
  expect_same([](auto& b) { return b.add(x(b), b.constant(0)); }, x);
  expect_same([](auto& b) { return b.add(b.constant(0), x(b)); }, x);
  expect_same([](auto& b) { return b.subtract(x(b), b.constant(0)); }, x);
  expect_same([](auto& b) { return b.multiply(b.constant(1), x(b)); }, x);
  expect_same([](auto& b) { return b.multiply(x(b), b.constant(1)); }, x);
  expect_same([](auto& b) { return b.divide(x(b), b.constant(1)); }, x);
  expect_same([](auto& b) { return b.negate(b.negate(x(b))); }, x);
  expect_same([](auto& b) { return b.power(x(b), 1); }, x);
}

TEST(ProgramBuilder, FoldsOperationsOnRationalsExactly) {
  expect_same([](auto& b) { return b.add(b.constant("1/10"), b.constant("2/10")); },
              [](auto& b) { return b.constant("3/10"); });
  expect_same([](auto& b) { return b.power(b.constant("2/3"), -2); },
              [](auto& b) { return b.constant("9/4"); });
  expect_same([](auto& b) { return b.call(Op::kSqrt, b.constant("9/4")); },
              [](auto& b) { return b.constant("3/2"); });
  expect_same([](auto& b) { return b.call(Op::kCos, b.constant(0)); },
              [](auto& b) { return b.constant(1); });
}

TEST(ProgramBuilder, LeavesIrrationalRootsAlone) {
  EXPECT_EQ(nodes_of([](auto& b) { return b.call(Op::kSqrt, b.constant(2)); }),
            "%0 = constant 2\n%1 = sqrt %0\noutputs %1\n");
}

TEST(ProgramBuilder, DropsATotalExpressionTimesZero) {
  expect_same([](auto& b) { return b.multiply(b.constant(0), b.call(Op::kSin, x(b))); },
              [](auto& b) { return b.constant(0); });
  expect_same([](auto& b) { return b.subtract(x(b), x(b)); },
              [](auto& b) { return b.constant(0); });
}

TEST(ProgramBuilder, KeepsWhatCanBeUndefinedTimesZero) {
  const std::string kept =
      "%0 = constant 0\n%1 = input 0\n%2 = sqrt %1\n%3 = multiply %0 %2\n"
      "outputs %3\n";
  EXPECT_EQ(nodes_of([](auto& b) { return b.multiply(b.constant(0), root(b)); }), kept);
  EXPECT_EQ(nodes_of([](auto& b) { return b.multiply(root(b), b.constant(0)); }), kept);
  EXPECT_EQ(nodes_of([](auto& b) { return b.subtract(root(b), root(b)); }), kept);
  EXPECT_NE(nodes_of([](auto& b) { return b.power(root(b), 0); }).find("sqrt"), std::string::npos);
}

TEST(ProgramBuilder, KeepsUndefinednessThroughSumsOfZeros) {
  EXPECT_NE(nodes_of([](auto& b) {
              return b.add(x(b), b.multiply(b.constant(0), b.call(Op::kSin, root(b))));
            }).find("sqrt"),
            std::string::npos);
}

TEST(ProgramBuilder, NeverCancelsAQuotient) {
  EXPECT_EQ(nodes_of([](auto& b) { return b.divide(x(b), x(b)); }),
            "%0 = input 0\n%1 = divide %0 %0\noutputs %1\n");
  EXPECT_EQ(nodes_of([](auto& b) { return b.divide(b.constant(0), x(b)); }),
            "%0 = constant 0\n%1 = input 0\n%2 = divide %0 %1\noutputs %2\n");
}

TEST(ProgramBuilder, KeepsADivisionByZero) {
  EXPECT_NE(nodes_of([](auto& b) { return b.divide(b.constant(1), b.constant(0)); }).find("divide"),
            std::string::npos);
  EXPECT_NE(nodes_of([](auto& b) { return b.power(b.constant(0), -1); }).find("divide"),
            std::string::npos);
}

TEST(ProgramBuilder, SquaresAProductOfEqualFactors) {
  expect_same([](auto& b) { return b.multiply(x(b), x(b)); },
              [](auto& b) { return b.power(x(b), 2); });
  expect_same([](auto& b) { return b.power(b.power(x(b), 2), 3); },
              [](auto& b) { return b.power(x(b), 6); });
}

TEST(ProgramBuilder, MovesSignsOutwards) {
  expect_same([](auto& b) { return b.add(x(b), b.negate(y(b))); },
              [](auto& b) { return b.subtract(x(b), y(b)); });
  expect_same([](auto& b) { return b.multiply(b.negate(x(b)), b.negate(y(b))); },
              [](auto& b) { return b.multiply(x(b), y(b)); });
  expect_same([](auto& b) { return b.call(Op::kCos, b.negate(x(b))); },
              [](auto& b) { return b.call(Op::kCos, x(b)); });
  expect_same([](auto& b) { return b.call(Op::kSin, b.negate(x(b))); },
              [](auto& b) { return b.negate(b.call(Op::kSin, x(b))); });
  expect_same([](auto& b) { return b.multiply(b.constant(-1), x(b)); },
              [](auto& b) { return b.negate(x(b)); });
}

TEST(ProgramBuilder, SharesWhatDiffersByItsSignAlone) {
  ProgramBuilder b({"x", "y"}, {});
  EXPECT_EQ(b.subtract(y(b), x(b)), b.negate(b.subtract(x(b), y(b))));
  EXPECT_EQ(b.multiply(b.constant(-7), x(b)), b.negate(b.multiply(b.constant(7), x(b))));
  EXPECT_EQ(b.subtract(b.negate(x(b)), y(b)), b.negate(b.add(x(b), y(b))));
  EXPECT_EQ(b.add(b.negate(x(b)), b.negate(y(b))), b.negate(b.add(x(b), y(b))));
  EXPECT_EQ(b.divide(b.negate(x(b)), y(b)), b.negate(b.divide(x(b), y(b))));
}

TEST(ProgramBuilder, SharesEqualNodesInEitherOrder) {
  ProgramBuilder b({"x", "y"}, {});
  EXPECT_EQ(b.add(x(b), y(b)), b.add(y(b), x(b)));
  EXPECT_EQ(b.multiply(x(b), y(b)), b.multiply(y(b), x(b)));
  EXPECT_NE(b.subtract(x(b), y(b)), b.subtract(y(b), x(b)));
  EXPECT_NE(b.divide(x(b), y(b)), b.divide(y(b), x(b)));
  EXPECT_EQ(b.constant("2/4"), b.constant("1/2"));
}

TEST(ProgramBuilder, DropsNodesThatNoOutputUses) {
  EXPECT_EQ(nodes_of([](auto& b) {
              b.call(Op::kExp, b.constant("7/3"));
              return x(b);
            }),
            "%0 = input 0\noutputs %0\n");
}

TEST(ProgramBuilder, NumbersNodesByTheOutputsAlone) {
  const auto build = [](bool other_order) {
    ProgramBuilder b({"x", "y"}, {"k"});
    if (other_order) b.multiply(y(b), b.constant("5/7"));
    const NodeId first = b.multiply(b.point(0), x(b));
    const NodeId second = b.add(y(b), b.constant("1/3"));
    b.output(first);
    b.output(second);
    return to_text(std::move(b).finish());
  };
  EXPECT_EQ(build(false), build(true));
}

TEST(ProgramBuilder, BuildsLongChainsWithoutRecursion) {
  ProgramBuilder b({"x", "y"}, {});
  NodeId chain = x(b);
  for (int i = 1; i <= 200000; ++i) chain = b.multiply(b.add(chain, y(b)), x(b));
  b.output(chain);
  EXPECT_EQ(std::move(b).finish().nodes.size(), 400002U);
}

TEST(ProgramBuilder, RefusesWhatIsNotDeclared) {
  ProgramBuilder b({"x"}, {"k"});
  EXPECT_THROW(b.input(1), std::out_of_range);
  EXPECT_THROW(b.point(1), std::out_of_range);
  EXPECT_THROW(b.output(99), std::out_of_range);
  EXPECT_THROW(b.negate(99), std::out_of_range);
  EXPECT_THROW(b.divide(b.input(0), 99), std::out_of_range);
  EXPECT_THROW(b.atan2(99, b.input(0)), std::out_of_range);
  EXPECT_THROW(b.call(Op::kAdd, b.input(0)), std::out_of_range);
  EXPECT_THROW(b.call(Op::kAtan2, b.input(0)), std::out_of_range);
  EXPECT_THROW(b.power(b.input(0), INT_MIN), std::out_of_range);
}

TEST(ProgramBuilder, DoesNotWriteOutEnormousPowers) {
  EXPECT_NE(nodes_of([](auto& b) { return b.power(b.constant("3/7"), 1000000); }).find("power"),
            std::string::npos);
}

}  // namespace
}  // namespace regulus::detail
