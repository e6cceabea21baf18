// SPDX-License-Identifier: GPL-3.0-or-later
// Random arms through every kind of file: the matrix against differences of forward kinematics that
// the tests have of their own.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "codegen/model/file/model_file.hpp"
#include "codegen/model/import/import.hpp"
#include "codegen/support/errors.hpp"
#include "tests/support/serial/random_chain.hpp"
#include "tests/support/serial/same_jacobian.hpp"

namespace regulus::detail::test {

/// Generic poses, and among them some where axes are parallel or cross.
inline std::vector<double> random_joints(RandomSource& random, std::size_t count) {
  const bool special = random.one_in(3);
  std::vector<double> q(count);
  for (double& x : q)
    x = special ? std::acos(0.0) * (double(random.below(5)) - 2) : random.between(-3.2, 3.2);
  return q;
}

inline double determinant_of(Table m) {
  double result = 1;
  for (std::size_t k = 0; k < m.size(); ++k) {
    const auto by_size = [k](const auto& row) { return std::fabs(row[k]); };
    const auto pivot =
        std::ranges::max_element(m.begin() + std::ptrdiff_t(k), m.end(), {}, by_size);
    if ((*pivot)[k] == 0) return 0;
    if (pivot != m.begin() + std::ptrdiff_t(k)) std::swap(*pivot, m[k]), result = -result;
    result *= m[k][k];
    for (std::size_t i = k + 1; i < m.size(); ++i)
      for (std::size_t j = m.size(); j-- > k;) m[i][j] -= m[i][k] / m[k][k] * m[k][j];
  }
  return result;
}

inline void expect_matrix(const Model& model, const RandomChain& chain, std::uint64_t seed) {
  ASSERT_EQ(model.pose.size(), chain.leaders());
  RandomSource random(seed);
  SameJacobian same;
  const auto frame = [&chain](const std::vector<double>& q) { return chain.tool(q); };
  for (int pose = 0; pose < 12 || !same.has_enough(); ++pose) {
    const auto q = random_joints(random, model.pose.size());
    const Table J = jacobian_of(model, q);
    same.add(J, difference_twists(frame, q));
    if (!model.jacobian) continue;
    EXPECT_NEAR(determinant_of(values_of(model.matrix, model, q)), determinant_of(J), 1e-9);
  }
  same.expect_forms();
  EXPECT_GE(same.compared(), 4);
}

/// Returns the model; nullopt for an arm that is refused because its matrix has too many terms.
inline std::optional<Model> model_of(const std::string& text, bool is_model) try {
  const std::string model = is_model ? text : import_robot(text, "arm", {}).model;
  return parse_model(model, "arm.toml");
} catch (const InputError& error) {
  EXPECT_NE(std::string(error.what()).find("terms"), std::string::npos) << error.what() << text;
  return std::nullopt;
}

/// Expects the matrix of `count` random arms in one kind of file.
inline void expect_chains(std::uint64_t first, int count, bool is_model,
                          std::string (RandomChain::*write)() const) {
  int refused = 0;
  for (std::uint64_t seed = first; seed < first + std::uint64_t(count); ++seed) {
    const RandomChain chain(seed);
    const std::string text = (chain.*write)();
    const auto model = model_of(text, is_model);
    if (!model) {
      ++refused;
      continue;
    }
    expect_matrix(*model, chain, seed);
    if (testing::Test::HasFailure()) FAIL() << "seed " << seed << '\n' << text;
  }
  EXPECT_LE(refused, count / 10);
}

}  // namespace regulus::detail::test
