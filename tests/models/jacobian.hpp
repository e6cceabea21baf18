// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the matrix of a model with rows computed in another way.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/models/rigid_body.hpp"
#include "tests/models/shipped_model.hpp"

namespace regulus::detail::test {

inline Vector<double> position_of(const Point& pose) {
  return {pose.at("x"), pose.at("y"), pose.at("z")};
}

/// Returns a row of derivatives of `quantity` by the six twists of a body at a pose.
template <typename Quantity>
Row derivatives(const Point& pose, Quantity quantity) {
  const auto angle = [&](const char* name) { return pose.count(name) ? pose.at(name) : 0; };
  Row row;
  for (std::size_t twist = 0; twist < 6; ++twist) {
    const Dual changed =
        quantity(MovingBody(position_of(pose), angle("roll"), angle("pitch"), angle("yaw"), twist));
    row.push_back(changed.slope);
  }
  return row;
}

inline void expect_equal(const Row& got, const Row& expected, double factor = 1) {
  ASSERT_EQ(got.size(), expected.size());
  double size = 0;
  for (const double entry : expected) size = std::max(size, std::abs(factor * entry));
  EXPECT_GT(size, 0);
  for (std::size_t j = 0; j < got.size(); ++j)
    EXPECT_NEAR(got[j], factor * expected[j], 1e-11 * size) << "column " << j + 1;
}

/// Expects rows that are equal up to a factor: they mean the same wrench.
inline void expect_parallel(const Row& got, const Row& expected) {
  ASSERT_EQ(got.size(), expected.size());
  const auto largest =
      std::max_element(expected.begin(), expected.end(),
                       [](double a, double b) { return std::abs(a) < std::abs(b); }) -
      expected.begin();
  expect_equal(got, expected, got[std::size_t(largest)] / expected[std::size_t(largest)]);
}

/// Draws poses from ranges, the same in every run.
class Poses {
 public:
  double between(double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(source_);
  }

 private:
  std::mt19937 source_{7};
};

/// Returns the determinant by elimination; for oracles only.
inline double approx_determinant(Rows m) {
  double result = 1;
  for (std::size_t k = 0; k < m.size(); ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < m.size(); ++i)
      if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
    if (m[pivot][k] == 0) return 0;
    if (pivot != k) std::swap(m[pivot], m[k]), result = -result;
    result *= m[k][k];
    for (std::size_t i = k + 1; i < m.size(); ++i)
      for (std::size_t j = m.size(); j-- > k;) m[i][j] -= m[i][k] / m[k][k] * m[k][j];
  }
  return result;
}

}  // namespace regulus::detail::test
