// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of passive constraints have no limits. The oracle is the one solution of a square system at random
// poses of a box, and forces that are planted where there are several.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "codegen/question/load/force_test.hpp"
#include "runtime/interval/floating_point_scope.hpp"
#include "tests/support/random_source.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test::free_forces_test {
namespace {

using Kind = ForceDecision::Kind;
using Doubles = std::vector<double>;

constexpr std::size_t kColumns = 6, kParameters = 2;

/// A(x) = A₀ + Σ x_k B_k, with |x_k| ≤ radius; the last rows are free, and the first have |f_i| ≤ 1.
struct Robot {
  std::size_t rows, free;
  double radius;
  std::vector<Doubles> parts;  ///< A₀, B₁, B₂: row-major

  Robot(RandomSource& random, std::size_t all, std::size_t without_limits)
      : rows(all), free(without_limits), radius(std::ldexp(1.0, -int(random.below(9)) - 2)) {
    for (std::size_t part = 0; part <= kParameters; ++part) {
      parts.emplace_back();
      for (std::size_t e = 0; e < rows * kColumns; ++e)
        parts.back().push_back(std::round(random.between(-64, 64)) / 64);
    }
  }

  [[nodiscard]] bool is_free(std::size_t row) const { return row >= rows - free; }
  [[nodiscard]] Doubles at(const Doubles& x) const {
    Doubles A = parts[0];
    for (std::size_t k = 0; k < kParameters; ++k)
      for (std::size_t e = 0; e < A.size(); ++e) A[e] += x[k] * parts[k + 1][e];
    return A;
  }
  [[nodiscard]] Doubles pose(RandomSource& random) const {
    Doubles x;
    for (std::size_t k = 0; k < kParameters; ++k) x.push_back(random.between(-radius, radius));
    return x;
  }
  [[nodiscard]] ForceDecision decide(const Doubles& wrench) const {
    ForceProblem problem{rows, kColumns, {}, {}, {}, {}, {}};
    for (std::size_t i = 0; i < rows; ++i) {
      problem.is_free.push_back(is_free(i));
      problem.certain.push_back(is_free(i) ? kEntire : Interval(-1, 1));
    }
    problem.possible = problem.certain;
    problem.corners.emplace_back(wrench.begin(), wrench.end());
    BoxMatrix box{{parts[0].begin(), parts[0].end()}, {}, Doubles(kParameters, radius)};
    for (std::size_t k = 1; k <= kParameters; ++k)
      box.slopes.insert(box.slopes.end(), parts[k].begin(), parts[k].end());
    const FloatingPointScope nearest(FloatingPointRounding::kNearest);
    return ForceTest(problem).decide(box);
  }
};

/// w = Aᵀf.
Doubles wrench_of(const Doubles& A, const Doubles& f) {
  Doubles w(kColumns, 0.0);
  for (std::size_t i = 0; i < f.size(); ++i)
    for (std::size_t j = 0; j < kColumns; ++j) w[j] += A[i * kColumns + j] * f[i];
  return w;
}

/// Solves Aᵀf = w of a square A; empty: it is nearly singular.
Doubles forces_of(const Doubles& A, Doubles f) {
  std::vector<Doubles> rows(kColumns, Doubles(kColumns));
  for (std::size_t i = 0; i < kColumns; ++i)
    for (std::size_t j = 0; j < kColumns; ++j) rows[j][i] = A[i * kColumns + j];
  for (std::size_t k = 0; k < kColumns; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < kColumns; ++i)
      if (std::fabs(rows[i][k]) > std::fabs(rows[pivot][k])) pivot = i;
    std::swap(rows[k], rows[pivot]), std::swap(f[k], f[pivot]);
    if (std::fabs(rows[k][k]) < 1e-3) return {};
    for (std::size_t i = 0; i < kColumns; ++i) {
      if (i == k) continue;
      const double factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j < kColumns; ++j) rows[i][j] -= factor * rows[k][j];
      f[i] -= factor * f[k];
    }
  }
  for (std::size_t k = 0; k < kColumns; ++k) f[k] /= rows[k][k];
  return f;
}

/// Forces within the limits, and large ones of the rows without limits.
Doubles planted(RandomSource& random, const Robot& robot, double most) {
  Doubles f;
  const double size = std::ldexp(1.0, int(random.below(14)) - 2);
  for (std::size_t i = 0; i < robot.rows; ++i)
    f.push_back(robot.is_free(i) ? random.between(-size, size) : random.between(-most, most));
  return f;
}

TEST(ForcesWithoutLimits, HoldALoadWhereTheOnlySolutionDoes) {
  RandomSource random(41);
  int held = 0, refused = 0;
  for (int round = 0; round < trials(4000, 100'000); ++round) {
    const Robot robot(random, kColumns, 1 + random.below(3));
    const Doubles w =
        wrench_of(robot.at(robot.pose(random)), planted(random, robot, random.between(0, 2)));
    const Kind kind = robot.decide(w).kind;
    if (kind == Kind::kUnknown) continue;
    ++(kind == Kind::kHeld ? held : refused);
    for (int sample = 0; sample < 4; ++sample) {
      const Doubles f = forces_of(robot.at(robot.pose(random)), w);
      if (f.empty()) continue;
      double largest = 0;
      for (std::size_t i = 0; i < robot.rows; ++i)
        if (!robot.is_free(i)) largest = std::fmax(largest, std::fabs(f[i]));
      EXPECT_TRUE(kind == Kind::kHeld ? largest < 1 + 1e-6 : largest > 1 - 1e-6) << largest;
    }
  }
  EXPECT_GE(held, 50);
  EXPECT_GE(refused, 50);
}

TEST(ForcesWithoutLimits, AreNeverSaidNotToHoldAPlantedLoad) {
  RandomSource random(42);
  int held = 0;
  for (int round = 0; round < trials(4000, 100'000); ++round) {
    const Robot robot(random, kColumns + 1 + random.below(2), 1 + random.below(3));
    const Doubles w = wrench_of(robot.at(robot.pose(random)), planted(random, robot, 0.999));
    const Kind kind = robot.decide(w).kind;
    EXPECT_NE(kind, Kind::kNotHeld);
    held += kind == Kind::kHeld;
  }
  EXPECT_GE(held, 50);
}

}  // namespace
}  // namespace regulus::detail::test::free_forces_test
