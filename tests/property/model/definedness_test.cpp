// SPDX-License-Identifier: GPL-3.0-or-later
// Compares written expressions with their parsed form: same values, defined at the same points.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "codegen/model/exact/expression_parser.hpp"
#include "codegen/support/errors.hpp"
#include "tests/support/evaluate.hpp"

namespace regulus::detail {
namespace {

using test::kUndefined;
using test::Point;

/// An expression as it is written, evaluated step by step without simplification. Points where an
/// operand is within rounding of the end of its domain are ambiguous; infinity marks them.
struct Written {
  std::string text;
  std::function<double(const Point&)> evaluate;
};

constexpr double kAmbiguous = std::numeric_limits<double>::infinity();
constexpr double kNear = 1e-9;

double settle(double value) { return std::fabs(value) > 1e12 ? kAmbiguous : value; }

double divide(double a, double b) {
  if (b == 0) return kUndefined;
  return std::fabs(b) < kNear ? kAmbiguous : settle(a / b);
}

double root(double a) {
  if (a < -kNear) return kUndefined;
  return a != 0 && std::fabs(a) < kNear ? kAmbiguous : std::sqrt(a);
}

double logarithm(double a) {
  if (a == 0 || a < -kNear) return kUndefined;
  return std::fabs(a) < kNear ? kAmbiguous : std::log(a);
}

double arc_sine(double a) {
  return std::fabs(std::fabs(a) - 1) < kNear ? kAmbiguous : std::asin(a);
}

double tangent(double a) {
  return std::fabs(std::cos(a)) < kNear ? kAmbiguous : settle(std::tan(a));
}

double arc_cosine(double a) { return std::isinf(arc_sine(a)) ? kAmbiguous : std::acos(a); }

double angle(double y, double x) {
  if (y == 0 && x == 0) return kUndefined;
  if (y == 0 && x < 0) return kUndefined;
  return std::fabs(y) < kNear && x < kNear && y != 0 ? kAmbiguous : std::atan2(y, x);
}

class Generator {
 public:
  explicit Generator(unsigned seed) : random_(seed) {}

  Written expression(int depth) {
    if (depth == 0) return leaf();
    switch (pick(17)) {
      case 0:
        return binary(depth, "+", [](double a, double b) { return settle(a + b); });
      case 1:
        return binary(depth, "-", [](double a, double b) { return settle(a - b); });
      case 2:
      case 3:
        return binary(depth, "*", [](double a, double b) { return settle(a * b); });
      case 4:
      case 5:
        return binary(depth, "/", divide);
      case 6:
        return unary(depth, "sqrt", root);
      case 7:
        return unary(depth, "log", logarithm);
      case 8:
        return unary(depth, "asin", arc_sine);
      case 9:
        return square(depth);
      case 10:
        return unary(depth, "abs", [](double a) { return std::fabs(a); });
      case 11:
        return unary(depth, "acos", arc_cosine);
      case 12:
        return unary(depth, "tan", tangent);
      case 13:
        return unary(depth, "atan", [](double a) { return std::atan(a); });
      case 14:
        return unary(depth, "exp", [](double a) { return settle(std::exp(a)); });
      case 15:
        return unary(depth, "cos", [](double a) { return std::cos(a); });
      default:
        return atan2(depth);
    }
  }

  int pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }

 private:
  Written leaf() {
    const int which = pick(8);
    if (which < 3) return {"x", [](const Point& p) { return p.at("x"); }};
    if (which < 6) return {"y", [](const Point& p) { return p.at("y"); }};
    const int value = pick(4);
    return {std::to_string(value), [value](const Point&) { return value; }};
  }

  template <typename Operation>
  Written binary(int depth, const std::string& symbol, Operation operation) {
    const Written a = expression(depth - 1), b = expression(depth - 1);
    std::string text("(");
    text.append(a.text).append(symbol).append(b.text).append(")");
    return {text, [=](const Point& p) { return combine(a.evaluate(p), b.evaluate(p), operation); }};
  }

  template <typename Operation>
  Written unary(int depth, const std::string& name, Operation operation) {
    const Written a = expression(depth - 1);
    std::string text(name);
    text.append("(").append(a.text).append(")");
    return {text, [=](const Point& p) {
              return combine(a.evaluate(p), 0, [&](double x, double) { return operation(x); });
            }};
  }

  Written square(int depth) {
    const Written a = expression(depth - 1);
    const bool negative = pick(2) == 0;
    std::string text("(");
    text.append(a.text).append(negative ? ")^-2" : ")^2");
    return {text, [=](const Point& p) {
              return combine(a.evaluate(p), 0, [&](double x, double) {
                return negative ? divide(1, x * x) : settle(x * x);
              });
            }};
  }

  Written atan2(int depth) {
    const Written a = expression(depth - 1), b = expression(depth - 1);
    std::string text("atan2(");
    text.append(a.text).append(", ").append(b.text).append(")");
    return {text, [=](const Point& p) { return combine(a.evaluate(p), b.evaluate(p), angle); }};
  }

  template <typename Operation>
  static double combine(double a, double b, Operation operation) {
    if (a == kAmbiguous || b == kAmbiguous) return kAmbiguous;
    return std::isnan(a) || std::isnan(b) ? kUndefined : operation(a, b);
  }

  std::mt19937_64 random_;
};

class TwoNames final : public Names {
 public:
  const ParsedExpression* find(const std::string& name, int) override {
    return name == "x" ? &x_ : name == "y" ? &y_ : nullptr;
  }
  std::vector<std::string> all() const override { return {"x", "y"}; }

 private:
  ParsedExpression x_ = variable(GiNaC::realsymbol("x")), y_ = variable(GiNaC::realsymbol("y"));
};

bool read_as_defined(const ParsedExpression& term, const Point& point) {
  if (std::isnan(test::evaluate(term.value, point))) return false;
  for (const GiNaC::ex& condition : term.must_be_defined)
    if (std::isnan(test::evaluate(condition, point))) return false;
  return true;
}

struct Counts {
  int defined = 0;
  int undefined = 0;
  int refused = 0;
};

void compare(const Written& written, const ParsedExpression& term, Counts& counts) {
  for (const double x : {-2.0, -1.0, -0.5, 0.0, 0.25, 1.0, 3.0})
    for (const double y : {-2.0, -1.0, 0.0, 0.5, 1.0, 3.0}) {
      const Point point = {{"x", x}, {"y", y}};
      const double expected = written.evaluate(point);
      if (expected == kAmbiguous) continue;
      const bool defined = read_as_defined(term, point);
      if (std::isnan(expected)) {
        ++counts.undefined;
        EXPECT_FALSE(defined) << written.text << " at " << x << ", " << y << " is undefined";
        continue;
      }
      ++counts.defined;
      EXPECT_TRUE(defined) << written.text << " at " << x << ", " << y << " is " << expected;
      EXPECT_NEAR(test::evaluate(term.value, point), expected,
                  1e-5 * std::max(1.0, std::fabs(expected)))
          << written.text << " at " << x << ", " << y;
    }
}

TEST(WrittenExpression, IsDefinedWhereItsReadingIsAndHasItsValue) {
  Counts counts;
  for (unsigned seed = 0; seed < 6000; ++seed) {
    Generator generator(seed);
    const Written written = generator.expression(1 + generator.pick(4));
    TwoNames names;
    try {
      compare(written, parse_expression(written.text, names, {}), counts);
    } catch (const InputError&) {
      ++counts.refused;  // a constant part is undefined, so the whole is undefined at every point
      for (const double x : {-2.0, -0.5, 0.25, 3.0}) {
        const double value = written.evaluate({{"x", x}, {"y", 0.7}});
        EXPECT_TRUE(std::isnan(value) || value == kAmbiguous) << written.text << " is " << value;
      }
    }
  }
  EXPECT_GT(counts.defined, 20000);
  EXPECT_GT(counts.undefined, 20000);
  EXPECT_GT(counts.refused, 100);
}

}  // namespace
}  // namespace regulus::detail
