// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/search/row_structure.hpp"

#include <gtest/gtest.h>

#include "support/function_kernel.hpp"

namespace regulus {
namespace {

using test::FunctionKernel;
using test::problem_over;
using test::Values;

/// Rows (x + u, 1), (v, x + v), (w, w·x) with u, v, w uncertain; s is shared by rows 0 and 1.
class Rows : public FunctionKernel {
 public:
  Rows()
      : FunctionKernel(5, 3, 2, [](const Values& x) {
          return Values{x[0] + x[1] + x[4], 1.0, x[2] + x[4], x[0] + x[2], x[3], x[3] * x[0]};
        }) {
    with_uncertain(4);
    with_derivatives([](const Values& x) {
      const Interval o(0.0), one(1.0);
      return Values{one, o, o,   one, o,   x[3],  // x
                    one, o, o,   o,   o,   o,     // u
                    o,   o, one, one, o,   o,     // v
                    o,   o, o,   o,   one, x[0],  // w
                    one, o, one, o,   o,   o};    // s
    });
  }
};

const std::vector<Interval> kRanges{{1, 2}, {-1, 1}, {-1, 1}, {-1, 1}, {-1, 1}};

TEST(RowStructure, FindsTheRowOfEachUncertainQuantity) {
  const Rows kernel;
  const RowStructure structure = find_row_structure(problem_over(kernel, kRanges), {});
  ASSERT_EQ(structure.slot.size(), 5U);
  const auto row = [&](std::size_t k) {
    return structure.rows[static_cast<std::size_t>(structure.slot[k])];
  };
  EXPECT_FALSE(structure.touches_one_row(0));
  EXPECT_EQ(row(1), 0U);
  EXPECT_EQ(row(2), 1U);
  EXPECT_EQ(row(3), 2U);
  EXPECT_FALSE(structure.touches_one_row(4));
}

TEST(RowStructure, IsEmptyWithoutDerivativesOrForOtherMethods) {
  Rows kernel;
  Settings settings;
  settings.method = Method::kKj;
  EXPECT_TRUE(find_row_structure(problem_over(kernel, kRanges), settings).empty());
  kernel.functions().left_derivatives = nullptr;
  EXPECT_TRUE(find_row_structure(problem_over(kernel, kRanges), {}).empty());
}

TEST(RowStructure, IsEmptyWhereADerivativeIsUndefined) {
  FunctionKernel kernel(2, 1, 1, [](const Values& x) { return Values{x[0] + sqrt(x[1])}; });
  kernel.with_uncertain(1).with_derivatives([](const Values& x) {
    return Values{1.0, 0.5 / sqrt(x[1])};
  });
  EXPECT_TRUE(find_row_structure(problem_over(kernel, {{1, 2}, {0, 1}}), {}).empty());
  EXPECT_FALSE(find_row_structure(problem_over(kernel, {{1, 2}, {0.5, 1}}), {}).empty());
}

/// (1 + x·c, a + u; b + v, 1): in each row one uncertain quantity.
FunctionKernel::Function two_by_two() {
  return [](const Values& x) { return Values{1.0, x[1], x[2] + x[0], 1.0}; };
}

TEST(RowStructure, CertifiesAllUncertainValuesAtOnce) {
  FunctionKernel kernel(3, 2, 2, two_by_two());
  kernel.with_uncertain(2).with_derivatives([](const Values&) {
    const Interval o(0.0), one(1.0);
    return Values{o, o, one, o, o, one, o, o, o, o, one, o};
  });
  // det = 1 − u(v + x).
  const Result free = solve(problem_over(kernel, {{0, 0.5}, {-1, 1}, {-0.4, 0.4}}), {});
  EXPECT_EQ(free.verdict, Verdict::kNoSingularity);
  EXPECT_GT(free.statistics.leaves[static_cast<std::size_t>(Rule::kStructured)], 0U);
  const Result singular = solve(problem_over(kernel, {{0, 0.5}, {-1, 1}, {-0.6, 0.6}}), {});
  EXPECT_EQ(singular.verdict, Verdict::kSingularity);
}

TEST(RowStructure, AMatrixUndefinedForSomeUncertainValueIsNotCertified) {
  // The derivative by u does not show that √(u + 1) is part of the matrix only for u ≥ −1.
  FunctionKernel kernel(2, 1, 1, [](const Values& x) {
    return Values{3.0 + x[0] + sqrt(x[1] + 1.0) - sqrt(x[1] + 1.0)};
  });
  kernel.with_uncertain(1).with_derivatives([](const Values&) { return Values{1.0, 0.25}; });
  EXPECT_EQ(solve(problem_over(kernel, {{0, 1}, {-0.5, 0.5}}), {}).verdict,
            Verdict::kNoSingularity);
  EXPECT_NE(solve(problem_over(kernel, {{0, 1}, {-2, 2}}), {}).verdict, Verdict::kNoSingularity);
}

}  // namespace
}  // namespace regulus
