// SPDX-License-Identifier: GPL-3.0-or-later
// Each pass keeps the function: values at random rational points are exactly equal.
#include "codegen/kernel/symbolic/passes.hpp"

#include <gtest/gtest.h>

#include "codegen/kernel/symbolic/derivative.hpp"
#include "codegen/kernel/symbolic/measure.hpp"
#include "codegen/kernel/symbolic/rewrite.hpp"
#include "tests/support/symbolic/exact_values.hpp"

namespace regulus::detail::test {
namespace {

class Passes : public ::testing::Test {
 protected:
  /// Calls check(natural, polynomial) for many random expressions.
  template <class Check>
  void for_random_polynomials(int count, Check check) {
    for (int i = 0; i < count; ++i) {
      Rewriter rewriter(variable_names(), point_names());
      const Expression e = RandomExpressions(random_).polynomial(3);
      const std::optional<Polynomial> p = rewriter.expander().expand(e);
      if (!p) continue;
      ++checked_;
      check(e, *p, rewriter);
      if (HasFailure()) FAIL() << "for " << to_string(e);
    }
    EXPECT_GT(checked_, count / 2);
  }

  void expect_equal(const Expression& a, const Expression& b) {
    for (int i = 0; i < 2; ++i) {
      ExactValues values(random_);
      EXPECT_EQ(values(a), values(b)) << to_string(a).substr(0, 500) << "\n"
                                      << to_string(b).substr(0, 500);
    }
  }

  std::mt19937_64 random_{20070601};
  int checked_ = 0;
};

TEST_F(Passes, CollectIsExact) {
  for_random_polynomials(300, [&](const Expression& e, const Polynomial& p, Rewriter& rewriter) {
    expect_equal(e, collect(p, rewriter.atoms()));
  });
}

TEST_F(Passes, HornerIsExactInEveryVariant) {
  for_random_polynomials(300, [&](const Expression& e, const Polynomial& p, Rewriter& rewriter) {
    for (const HornerOrder order : {HornerOrder::kMostFrequent, HornerOrder::kVariablesFirst})
      for (const bool factor : {false, true})
        for (const bool squares : {false, true})
          expect_equal(e, horner(p, rewriter.atoms(), {order, factor, squares}));
  });
}

TEST_F(Passes, HornerNeverCostsMoreThanCollect) {
  for_random_polynomials(300, [&](const Expression&, const Polynomial& p, Rewriter& rewriter) {
    const std::uint64_t collected = width_cost(collect(p, rewriter.atoms()));
    EXPECT_LE(width_cost(horner(p, rewriter.atoms())), collected);
    EXPECT_LE(width_cost(horner(p, rewriter.atoms(), {HornerOrder::kVariablesFirst, true, true})),
              collected);
  });
}

TEST_F(Passes, MergingAnglesIsExact) {
  int merged_some = 0;
  for_random_polynomials(300, [&](const Expression& e, const Polynomial& p, Rewriter& rewriter) {
    const auto simplify = [&](const Expression& argument) {
      return collect(*rewriter.expander().expand(argument), rewriter.atoms());
    };
    for (const TrigonometricOptions options :
         {TrigonometricOptions{true, false}, {true, true}, {false, true}, {false, false}}) {
      const Polynomial merged =
          merge_angles(p, rewriter.atoms(), rewriter.expander(), simplify, options);
      merged_some += !(merged == p);
      expect_equal(e, collect(merged, rewriter.atoms()));
    }
  });
  EXPECT_GT(merged_some, 50);
}

/// Returns ±m·(cos u cos v ± sin u sin v) or ±m·(sin u cos v ± cos u sin v) with random signs and
/// factors. Some match a formula, and some only look like one.
Expression nearly_an_addition_formula(RandomExpressions& expressions) {
  const Expression u = expressions.angle(), v = expressions.angle();
  const auto circular = [&](const Expression& angle) {
    return call(expressions.below(2) == 0 ? Call::kSin : Call::kCos, {angle});
  };
  const Expression m = expressions.leaf();
  Expressions terms;
  for (int i = 0; i < 4; ++i) {
    const Expression factor(expressions.below(2) * 2 - 1 + (expressions.below(6) == 0));
    terms.push_back(product({factor, m, circular(u), circular(v)}));
  }
  return sum(terms);
}

TEST_F(Passes, MergingAnglesIsExactWhereAdditionFormulasNearlyMatch) {
  int new_angles = 0;
  for (int i = 0; i < 500; ++i) {
    Rewriter rewriter(variable_names(), point_names());
    RandomExpressions expressions(random_);
    const Expression e =
        nearly_an_addition_formula(expressions) + nearly_an_addition_formula(expressions);
    const auto simplify = [&](const Expression& argument) {
      return collect(*rewriter.expander().expand(argument), rewriter.atoms());
    };
    for (const bool doubles : {false, true}) {
      const Polynomial merged = merge_angles(*rewriter.expander().expand(e), rewriter.atoms(),
                                             rewriter.expander(), simplify, {true, doubles});
      const Expression form = collect(merged, rewriter.atoms());
      new_angles += count_occurrences(form) != count_occurrences(e);
      expect_equal(e, form);
    }
    ASSERT_FALSE(HasFailure()) << to_string(e);
  }
  EXPECT_GT(new_angles, 300);
}

TEST_F(Passes, FactoredSplitsMultiplyBackToTheOriginal) {
  int by_first = 0, by_second = 0;
  for (int i = 0; i < 300; ++i) {
    Rewriter rewriter(variable_names(), point_names());
    RandomExpressions expressions(random_);
    const auto polynomial = [&](int depth) {
      return *rewriter.expander().expand(expressions.polynomial(depth));
    };
    const Polynomial outer = polynomial(0), common = polynomial(1), s = polynomial(1);
    if (outer.is_zero() || common.is_zero() || s.is_zero()) continue;
    // First r is a multiple of q, then q is a multiple of r.
    if (const auto f = factor_split(outer, common, common * s)) {
      ++by_first;
      EXPECT_TRUE(f->first * f->second == outer * common + common * s);
    }
    if (const auto f = factor_split(outer, common * s, common)) {
      ++by_second;
      EXPECT_TRUE(f->first * f->second == outer * common * s + common);
    }
  }
  EXPECT_GT(by_first, 50);
  EXPECT_GT(by_second, 50);
}

TEST_F(Passes, DivisionFindsWhatWasMultiplied) {
  int divided = 0;
  for (int i = 0; i < 300; ++i) {
    Rewriter rewriter(variable_names(), point_names());
    RandomExpressions expressions(random_);
    const auto p = rewriter.expander().expand(expressions.polynomial(2));
    const auto q = rewriter.expander().expand(expressions.polynomial(2));
    if (!p || !q || q->is_zero() || p->terms().size() * q->terms().size() > 5000) continue;
    const auto quotient = divide_exactly(*p * *q, *q);
    ASSERT_TRUE(quotient.has_value());
    EXPECT_TRUE(*quotient == *p);
    ++divided;
    if (q->terms().size() < 2) continue;
    EXPECT_FALSE(divide_exactly(*p * *q + Polynomial(1), *q).has_value());
  }
  EXPECT_GT(divided, 150);
}

TEST_F(Passes, RewritingIsExactAndNeverCostsMore) {
  int rewritten = 0, evaluated = 0;
  for (int i = 0; i < 400; ++i) {
    Rewriter rewriter(variable_names(), point_names());
    const Expression e = RandomExpressions(random_).general(3);
    const Rewritten result = rewriter.rewrite(e);
    EXPECT_LE(width_cost(result.expression), width_cost(e)) << to_string(e);
    rewritten += !(result.expression == e);
    ExactValues values(random_);
    std::optional<cl_RA> expected;
    try {
      expected = values(e);
    } catch (const std::domain_error&) {
      continue;  // undefined at this point, so nothing is claimed there
    }
    ++evaluated;
    EXPECT_EQ(*expected, values(result.expression))
        << to_string(e) << "\n"
        << to_string(result.expression) << " by " << result.passes;
  }
  EXPECT_GT(rewritten, 150);
  EXPECT_GT(evaluated, 250);
}

TEST_F(Passes, FormsDoNotDependOnTheOrderOfOperands) {
  for (int i = 0; i < 200; ++i) {
    const std::uint64_t seed = random_();
    std::mt19937_64 one(seed);
    const Expression e = RandomExpressions(one).polynomial(3);
    Rewriter first(variable_names(), point_names()), second(variable_names(), point_names());
    // The second rewriter has seen other expressions before, so that its atoms have other
    // numbers.
    static_cast<void>(
        second.rewrite(call(Call::kCos, {variable("c")}) * call(Call::kSin, {variable("b")}) +
                       call(Call::kCos, {variable("a")})));
    EXPECT_EQ(to_string(first.rewrite(e).expression), to_string(second.rewrite(e).expression));
  }
}

}  // namespace
}  // namespace regulus::detail::test
