// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/symbolic/kept_powers.hpp"

#include <gtest/gtest.h>

#include "codegen/kernel/symbolic/print.hpp"

namespace regulus::detail::kept_powers {
namespace {

const Expression x = variable("x"), y = variable("y");

TEST(KeptPowers, AreSymbolsUntilTheyAreRevealed) {
  KeptPowers powers(1);
  const Expression square = power(x + y, 2), e = square * call(Call::kSqrt, {square + 1});
  const Expression hidden = powers.hide(e);
  EXPECT_EQ(to_string(hidden).find("x"), std::string::npos) << to_string(hidden);
  EXPECT_EQ(powers.reveal(hidden), e);
  EXPECT_TRUE(powers.must_be_defined().empty());
  EXPECT_EQ(powers.hide(power(x - y, 2)), power(x - y, 2)) << "there is one symbol only";
}

TEST(KeptPowers, AreNotThoseOfVariables) {
  KeptPowers powers(8);
  EXPECT_EQ(powers.hide(power(x, 2) + power(x + y, -1)), power(x, 2) + power(x + y, -1));
}

TEST(KeptPowers, SplitFunctionsWhereThePartsAreDefined) {
  KeptPowers powers(8);
  const Expression root_x = call(Call::kSqrt, {x}), root_y = call(Call::kSqrt, {y});
  EXPECT_EQ(powers.hide(call(Call::kSqrt, {x * y})), root_x * root_y);
  EXPECT_EQ(powers.must_be_defined(), (Expressions{root_x, root_y}));
  const Expression cosine = power(call(Call::kCos, {x}), -1);
  EXPECT_EQ(powers.hide(call(Call::kTan, {x})), call(Call::kSin, {x}) * cosine);
  EXPECT_EQ(powers.must_be_defined().back(), cosine);
}

TEST(KeptPowers, CancelInversesThatMustBeDefined) {
  KeptPowers powers(8);
  AtomTable atoms({"x", "y"}, {});
  Expander expander(atoms);
  const Expression inverse = power(x, -1);
  const Polynomial p = *expander.expand(product({x, x, inverse, y}));
  EXPECT_EQ(powers.without_inverses(p, atoms), *expander.expand(x * y));
  EXPECT_EQ(powers.must_be_defined(), Expressions{inverse});
}

}  // namespace
}  // namespace regulus::detail::kept_powers
