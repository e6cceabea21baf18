// SPDX-License-Identifier: GPL-3.0-or-later
// Takes x^(p/q) as it is written through the parser and the lowering to a program: Arb's balls and
// double intervals contain MPFR's value, and so do their derivatives.
#include <gtest/gtest.h>
#include <mpfr.h>

#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <string>

#include "codegen/kernel/program/arb_arithmetic.hpp"
#include "codegen/kernel/program/enclose.hpp"
#include "codegen/kernel/program/interval_arithmetic.hpp"
#include "codegen/kernel/symbolic/derivative.hpp"
#include "codegen/kernel/symbolic/from_ginac.hpp"
#include "codegen/kernel/symbolic/lowering.hpp"
#include "codegen/model/exact/expression_parser.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail {
namespace {

using test::RandomSource;

class OneName final : public Names {
 public:
  const ParsedExpression* find(const std::string& name, int) override {
    return name == "x" ? &term_ : nullptr;
  }
  std::vector<std::string> all() const override { return {"x"}; }
  [[nodiscard]] const GiNaC::realsymbol& symbol() const { return symbol_; }

 private:
  GiNaC::realsymbol symbol_{"x"};
  ParsedExpression term_ = variable(symbol_);
};

struct Power {
  int p = 1, q = 1;
  Expression expression{};
};

Program program_of(const Expression& e) {
  Lowering lowering({"x"}, {});
  lowering.output(e);
  return std::move(lowering).finish();
}

/// Computes x^(p/q) to 300 bits as the root of x^p, which needs neither log nor exp.
class Value {
 public:
  Value(double x, int p, int q) {
    for (auto* v : {&value_, &bound_, &slack_}) mpfr_init2(*v, 300);
    mpfr_set_d(value_, x, MPFR_RNDN);
    mpfr_pow_si(value_, value_, p, MPFR_RNDN);
    mpfr_rootn_ui(value_, value_, static_cast<unsigned long>(q), MPFR_RNDN);
  }
  Value(const Value&) = delete;
  Value& operator=(const Value&) = delete;
  ~Value() {
    for (auto* v : {&value_, &bound_, &slack_}) mpfr_clear(*v);
  }
  /// Replaces the value by p/q · x^(p/q − 1).
  void derive(double x, int p, int q) {
    mpfr_mul_si(value_, value_, p, MPFR_RNDN);
    mpfr_div_si(value_, value_, q, MPFR_RNDN);
    mpfr_div_d(value_, value_, x, MPFR_RNDN);
  }
  /// Allows for the few roundings of 300 bits.
  [[nodiscard]] bool is_in(const Interval& x) {
    mpfr_abs(slack_, value_, MPFR_RNDU);
    mpfr_mul_2si(slack_, slack_, -280, MPFR_RNDU);
    mpfr_add(bound_, value_, slack_, MPFR_RNDU);
    const bool above = mpfr_cmp_d(bound_, x.lo) >= 0;
    mpfr_sub(bound_, value_, slack_, MPFR_RNDD);
    return above && mpfr_cmp_d(bound_, x.hi) <= 0;
  }

 private:
  mpfr_t value_, bound_, slack_;
};

std::optional<Interval> by_arb(const Program& program, double x) {
  ArbArithmetic arithmetic(200);
  const Ball at(x);
  const auto outputs = evaluate<ArbArithmetic>(program, std::span(&at, 1), {}, arithmetic);
  if (arithmetic.undefined()) return std::nullopt;
  return outputs[0].enclosure();
}

std::optional<Interval> by_intervals(const Program& program, const Interval& x) {
  IntervalArithmetic arithmetic;
  std::vector<Interval> values(program.nodes.size());
  run<IntervalArithmetic, Interval>(program, enclose_constant_nodes(program), std::span(&x, 1), {},
                                    values, arithmetic);
  if (arithmetic.undefined()) return std::nullopt;
  return values[program.outputs[0]];
}

class RationalPower : public testing::Test {
 protected:
  static Power read(int p, int q) {
    OneName names;
    const std::string text = "x^(" + std::to_string(p) + "/" + std::to_string(q) + ")";
    const ParsedExpression term = parse_expression(text, names, {.file = "", .key = "test"});
    const SymbolMeaning meaning{{names.symbol(), variable("x")}};
    return {p, q, GinacReader(meaning).read(term.value)};
  }
  Power random_power() {
    static constexpr int kDenominators[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 16, 24, 64, 100, 8192};
    for (;;) {
      const int q = kDenominators[random_.below(std::size(kDenominators))];
      const int p = static_cast<int>(random_.below(12 * static_cast<std::uint64_t>(q))) - 6 * q;
      if (p != 0) return read(p, q);
    }
  }
  RandomSource random_{1848};
};

TEST_F(RationalPower, IsEnclosedByBallsAndIntervals) {
  for (int i = 0; i < 2000; ++i) {
    const Power power = random_power();
    const double x = std::ldexp(1 + random_.unit(), static_cast<int>(random_.below(40)) - 20);
    const Program program = program_of(power.expression);
    Value value(x, power.p, power.q);
    const auto ball = by_arb(program, x);
    const auto interval = by_intervals(program, Interval(x, x));
    const auto wide = by_intervals(program, Interval(x / (1 + random_.unit()), x * 1.5));
    ASSERT_TRUE(ball && interval && wide) << power.p << "/" << power.q << " at " << x;
    for (const Interval& enclosure : {*ball, *interval, *wide})
      EXPECT_TRUE(value.is_in(enclosure)) << power.p << "/" << power.q << " at " << x;
    EXPECT_LT(ball->hi - ball->lo, 1e-12 * std::fabs(ball->hi) + 1e-300);
  }
}

TEST_F(RationalPower, HasADerivativeThatIsEnclosed) {
  for (int i = 0; i < 1000; ++i) {
    const Power power = random_power();
    const double x = std::ldexp(1 + random_.unit(), static_cast<int>(random_.below(20)) - 10);
    const Program program = program_of(Differentiator("x").derivative(power.expression));
    Value value(x, power.p, power.q);
    value.derive(x, power.p, power.q);
    const auto ball = by_arb(program, x);
    ASSERT_TRUE(ball) << power.p << "/" << power.q << " at " << x;
    EXPECT_TRUE(value.is_in(*ball)) << power.p << "/" << power.q << " at " << x;
  }
}

TEST_F(RationalPower, IsDefinedWhereThePageSaysSo) {
  for (int i = 0; i < 500; ++i) {
    const Power power = random_power();
    const bool whole = power.p % power.q == 0;
    if (whole && power.p > 0) continue;
    const Program program = program_of(power.expression);
    int odd = power.q / std::gcd(power.p, power.q);
    while (odd % 2 == 0) odd /= 2;
    EXPECT_EQ(by_arb(program, 0.0).has_value(), odd == 1 && power.p > 0)
        << power.p << "/" << power.q;
    EXPECT_EQ(by_arb(program, -1.0).has_value(), whole) << power.p << "/" << power.q;
    EXPECT_FALSE(by_intervals(program, Interval(-0x1p-60, 1))) << power.p << "/" << power.q;
  }
}

}  // namespace
}  // namespace regulus::detail
