// SPDX-License-Identifier: GPL-3.0-or-later
// Exact values of expressions, to compare a rewritten form with the original. Each angle gets a
// rational point of the unit circle as cosine and sine, so the addition formulas and sin² + cos² =
// 1 hold exactly. Other functions are arbitrary functions with the right symmetry.
#pragma once

#include <cln/integer.h>
#include <cln/rational.h>

#include <map>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "codegen/kernel/symbolic/evaluate.hpp"
#include "codegen/kernel/symbolic/print.hpp"

namespace regulus::detail::test {

using cln::cl_RA;

inline cl_RA random_rational(std::mt19937_64& random) {
  const int numerator = std::uniform_int_distribution<int>(-12, 12)(random);
  const int denominator = std::uniform_int_distribution<int>(1, 7)(random);
  return cl_RA(numerator) / denominator;
}

struct CirclePoint {
  cl_RA sine = 0;
  cl_RA cosine = 1;
};

inline CirclePoint operator+(const CirclePoint& a, const CirclePoint& b) {
  return {a.sine * b.cosine + a.cosine * b.sine, a.cosine * b.cosine - a.sine * b.sine};
}

inline CirclePoint times(int n, CirclePoint p) {
  if (n < 0) {
    p.sine = -p.sine;
    n = -n;
  }
  CirclePoint result;
  for (int i = 0; i < n; ++i) result = result + p;
  return result;
}

/// Values of symbols, chosen at the first request. A variable inside a sine or cosine has a point
/// of the circle, which is independent of its value as a number.
class ExactValues {
 public:
  explicit ExactValues(std::mt19937_64& random) : random_(&random) {}

  cl_RA operator()(const Expression& e) { return evaluate(e, known()); }

  ValueOf known() {
    return [this](const Expression& e) -> std::optional<cl_RA> { return value_of(e); };
  }

  cl_RA symbol(const std::string& name) {
    const auto found = symbols_.find(name);
    if (found != symbols_.end()) return found->second;
    return symbols_.emplace(name, random_rational(*random_)).first->second;
  }

  CirclePoint point_of(const std::string& angle) {
    const auto found = points_.find(angle);
    if (found != points_.end()) return found->second;
    const cl_RA t = random_rational(*random_), d = 1 + t * t;
    return points_.emplace(angle, CirclePoint{2 * t / d, (1 - t * t) / d}).first->second;
  }

  /// Returns the point of an integer combination of angles.
  CirclePoint circle(const Expression& argument) {
    switch (argument.kind()) {
      case ExpressionKind::kConstant:
        if (zerop(argument.value())) return {};
        break;
      case ExpressionKind::kVariable:
        return point_of(argument.name());
      case ExpressionKind::kSum: {
        CirclePoint result;
        for (const Expression& term : argument.operands()) result = result + circle(term);
        return result;
      }
      case ExpressionKind::kProduct: {
        const cl_RA c = coefficient_of(argument);
        if (c == 1 || denominator(c) != 1) break;
        return times(cl_I_to_int(numerator(c)), circle(divide_by(argument, c)));
      }
      default:
        break;
    }
    throw std::domain_error("not a combination of angles: " + to_string(argument));
  }

 private:
  std::optional<cl_RA> value_of(const Expression& e) {
    if (e.kind() == ExpressionKind::kVariable || e.kind() == ExpressionKind::kPoint)
      return symbol(e.name());
    if (e.kind() == ExpressionKind::kNumberPi) return symbol("pi");
    if (e.kind() != ExpressionKind::kCall) return std::nullopt;
    const Expression& argument = e.operands()[0];
    if (e.function() == Call::kSin) return circle(argument).sine;
    if (e.function() == Call::kCos) return circle(argument).cosine;
    const cl_RA v = evaluate(argument, known());
    switch (e.function()) {
      case Call::kTan:
      case Call::kAtan:
      case Call::kAsin:
        return v * v * v + 2 * v;
      case Call::kAtan2:
        return v + 3 * evaluate(e.operands()[1], known());
      case Call::kAbs:
        return std::nullopt;
      default:
        return v * v / 2 + v + 5 + static_cast<int>(e.function());
    }
  }

  std::mt19937_64* random_;
  std::map<std::string, cl_RA> symbols_;
  std::map<std::string, CirclePoint> points_;
};

/// Makes random expressions in variables x y z, angles a b c and entries of K.
class RandomExpressions {
 public:
  explicit RandomExpressions(std::mt19937_64& random) : random_(&random) {}

  Expression polynomial(int depth) {
    if (depth == 0) return leaf();
    switch (below(5)) {
      case 0:
        return leaf();
      case 1:
        return power(polynomial(depth - 1), 2 + below(2));
      case 2:
        return product({polynomial(depth - 1), polynomial(depth - 1)});
      default:
        return sum({polynomial(depth - 1), polynomial(depth - 1), polynomial(depth - 1)});
    }
  }

  /// Returns an expression that may also contain functions and divisions.
  Expression general(int depth) {
    if (depth == 0) return leaf();
    const Expression inner = general(depth - 1);
    switch (below(6)) {
      case 0:
        return call(kFunctions[static_cast<std::size_t>(below(7))], {inner});
      case 1:
        return call(Call::kAtan2, {inner, general(depth - 1)});
      case 2:
        return power(inner, -1 - below(2));
      case 3:
        return product({inner, general(depth - 1)});
      default:
        return sum({inner, general(depth - 1), general(depth - 1)});
    }
  }

  Expression leaf() {
    switch (below(8)) {
      case 0:
        return Expression(random_rational(*random_));
      case 1:
        return point("k_1_" + std::to_string(1 + below(3)));
      case 2:
        return below(4) == 0 ? pi() : variable("x");
      case 3:
      case 4:
        return variable(std::string(1, static_cast<char>('x' + below(3))));
      case 5:
        return call(Call::kSin, {angle()});
      default:
        return call(Call::kCos, {angle()});
    }
  }

  Expression angle() {
    const Expression a = variable(std::string(1, static_cast<char>('a' + below(3))));
    return below(4) != 0 ? a : a + Expression(below(3) - 1) * variable("b");
  }

  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(*random_); }

 private:
  static constexpr Call kFunctions[7] = {Call::kSqrt, Call::kTan, Call::kAsin, Call::kAcos,
                                         Call::kAtan, Call::kExp, Call::kAbs};
  std::mt19937_64* random_;
};

inline std::vector<std::string> variable_names() { return {"x", "y", "z", "a", "b", "c"}; }
inline std::vector<std::string> point_names() { return {"k_1_1", "k_1_2", "k_1_3"}; }

}  // namespace regulus::detail::test
