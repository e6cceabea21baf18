// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/analysis/null_vectors.hpp"

#include <gtest/gtest.h>

namespace regulus::detail {
namespace {

using Values = std::vector<double>;

TEST(NullVectors, OfARegularMatrixAreNone) {
  const NullVectors null = approx_null_vectors(Values{2, 1, 1, 2}, 2, 2);
  EXPECT_EQ(null.nullity(), 0U);
  ASSERT_EQ(null.singular_values.size(), 2U);
  EXPECT_EQ(null.singular_values[0], 1);
  EXPECT_NEAR(null.singular_values[1], 1.0 / 3, 1e-12);
}

TEST(NullVectors, OfBothSidesAreFound) {
  // Rows 1 and 2 cancel; the matrix maps (2, -1, 0) to zero.
  const NullVectors null = approx_null_vectors(Values{1, 2, 3, -1, -2, -3, 0, 0, 5}, 3, 3);
  ASSERT_EQ(null.nullity(), 1U);
  EXPECT_NEAR(null.right[0][0] / null.right[0][1], -2, 1e-12);
  EXPECT_EQ(null.right[0][2], 0);
  EXPECT_NEAR(null.left[0][0] / null.left[0][1], 1, 1e-12);
  EXPECT_EQ(null.left[0][2], 0);
}

TEST(NullVectors, DoNotDependOnUnits) {
  // The same matrix, with its second column, third column and second row multiplied by 100.
  const NullVectors null =
      approx_null_vectors(Values{1, 200, 0.03, -100, -20000, -3, 0, 0, 0.05}, 3, 3);
  ASSERT_EQ(null.nullity(), 1U);
  EXPECT_NEAR(null.right[0][0] / null.right[0][1], -200, 1e-9);
  EXPECT_NEAR(null.left[0][0] / null.left[0][1], 100, 1e-9);
}

TEST(NullVectors, SeeARowAndAColumnThatVanish) {
  const NullVectors null = approx_null_vectors(Values{1e-17, 0, 0, 3}, 2, 2);
  ASSERT_EQ(null.nullity(), 1U);
  EXPECT_EQ(null.right[0][1], 0);
  EXPECT_EQ(null.left[0][1], 0);
  EXPECT_EQ(approx_null_vectors(Values{0, 0, 0, 0}, 2, 2).nullity(), 2U);
}

TEST(NullVectors, OfMoreRowsThanColumnsAreThoseOfTheColumns) {
  const NullVectors null = approx_null_vectors(Values{1, 1, 2, 2, -1, -1}, 3, 2);
  ASSERT_EQ(null.nullity(), 1U);
  EXPECT_NEAR(null.right[0][0] / null.right[0][1], -1, 1e-12);
  EXPECT_TRUE(null.left.empty());
}

}  // namespace
}  // namespace regulus::detail
