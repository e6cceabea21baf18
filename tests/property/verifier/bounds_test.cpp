// SPDX-License-Identifier: GPL-3.0-or-later
// Computes the quantities that the test of regularity bounds at points of the box, with 200 bits;
// they must lie within the bounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <sstream>

#include "runtime/verifier/ball_matrix.hpp"
#include "runtime/verifier/touched_rows.hpp"

namespace regulus::detail::test {
namespace {

using namespace verifier;

constexpr long kBits = 200;

/// Three questions: entries with products of moving quantities; quantities of one row; both and a
/// rectangular matrix. {claim, the lines after alpha}
const std::vector<std::pair<std::string, std::string>> kQuestions = {
    {"the full 2x2 matrix of the model is defined and has full rank at every pose of the variety",
     "parameter x in 1 : 2\nparameter t in 0 : 1\npose x = x\npose t = t\nmatrix 2 2\n"
     "entry x*cos(t) + 3\nentry x^2*sin(t)\nentry sqrt(x + t) - x\nentry 4 + exp(t)*x\n"},
    {"the full 2x2 matrix of the model is defined and has full rank at every pose and value of the "
     "3 uncertain quantities of the variety",
     "parameter x in 1 : 2\nparameter t in 0 : 1\nuncertain a = 3 +- 1/2\nuncertain b = 4 +- 1/3\n"
     "uncertain c = 1 +- 1/4\npose x = x\npose t = t\nmatrix 2 2\n"
     "entry x*cos(t) + a*x\nentry a^2*sin(t) + c*t\nentry sqrt(x + t) - b*x\nentry 4 + "
     "exp(t)*b\n"},
    {"the full 3x2 matrix of the model is defined and has full rank at every pose and value of the "
     "4 uncertain quantities of the variety",
     "parameter x in 1 : 2\nuncertain a = 3 +- 1/2\nuncertain b = 4 +- 1/3\nuncertain c = 1 +- "
     "1/4\npose x = x +- 1/10\nmatrix 3 2\nentry x + a\nentry a*x^2\nentry b - x\nentry "
     "sin(x*b)\nentry x^3\nentry 2 - x*c\n"}};

class Bounds : public ::testing::TestWithParam<std::size_t> {
 protected:
  Bounds() {
    const auto& [claim, rest] = kQuestions[GetParam()];
    std::istringstream stream("regulus-certificate 1\nverdict NO SINGULARITY\nclaim " + claim +
                              "\nmodel m\nsha256 -\nmotion m\nalpha 0\n" + rest + "proof\n");
    Lines lines(stream);
    read_question(lines, q_);
    variety_ = enclose_variety(q_);
    for (std::size_t k = 0; k < q_.variables.size(); ++k)
      if (q_.variables[k].kind == VariableKind::kParameter ||
          (q_.variables[k].kind == VariableKind::kError))
        moving_.push_back(k);
  }

  /// Chooses a part of the variety, and sets its middle and radius.
  void choose_box() {
    box_ = middle_ = variety_.outer;
    r_.assign(box_.size(), 0.0);
    for (std::size_t k = 0; k < box_.size(); ++k) {
      const double width = box_[k].hi - box_[k].lo, part = 0.02 + 0.2 * uniform();
      box_[k].lo += (1 - part) * uniform() * width;
      box_[k].hi = box_[k].lo + part * width;
      middle_[k] = point(mid(box_[k]));
      r_[k] = radius_ru(box_[k], middle_[k].lo);
    }
    thin_ = middle_;
    for (const std::size_t p : moving_) thin_[p] = box_[p];
  }

  /// Chooses ends of ranges more often than other values.
  Box choose_point(const Box& box) {
    Box result = box;
    for (Interval& x : result) {
      const double u = uniform();
      x = point(u < 0.4 ? x.lo : u < 0.8 ? x.hi : x.lo + uniform() * (x.hi - x.lo));
    }
    return result;
  }

  /// Computes A at a point.
  void evaluate_matrix(const Box& at, BallMatrix& A) {
    std::vector<Ball> variables;
    for (const Interval x : at) variables.emplace_back(x, kBits);
    const auto values = evaluate(q_.graph, q_.matrix, variables, kBits);
    ASSERT_TRUE(values);
    for (std::size_t e = 0; e < values->size(); ++e)
      arb_set(A.at(e / q_.columns, e % q_.columns), (*values)[e].get());
  }

  /// Computes K(t) = (I − Σ τ_pD_p)K.
  void moving_K(const MovingInverse& inverse, const Box& at, BallMatrix& K) {
    const std::size_t n = q_.columns;
    BallMatrix follow(n, n), fixed(n, q_.rows);
    arb_mat_one(follow.get());
    for (std::size_t p = 0; p < moving_.size(); ++p) {
      Ball tau(at[moving_[p]], kBits);
      arb_sub(tau.get(), tau.get(), Ball(middle_[moving_[p]], kBits).get(), kBits);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          arb_submul(follow.at(i, j), tau.get(), Ball(point(inverse.D(p)[j * n + i]), kBits).get(),
                     kBits);
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < q_.rows; ++j) arb_set_d(fixed.at(i, j), inverse.K()[j * n + i]);
    arb_mat_mul(K.get(), follow.get(), fixed.get(), kBits);
  }

  /// Returns |x| / bound; fails if it certainly exceeds 1.
  static double compare(arb_srcptr x, double bound) {
    Ball size, most(point(bound), kBits);
    arb_abs(size.get(), x);
    EXPECT_FALSE(arb_gt(size.get(), most.get())) << size.enclosure().lo << " > " << bound;
    return size.enclosure().lo / bound;
  }

  double uniform() { return std::uniform_real_distribution<double>()(random_); }

  Question q_;
  Variety variety_;
  std::vector<std::size_t> moving_;
  Box box_, middle_, thin_;
  std::vector<double> r_;
  std::mt19937_64 random_{20071};
};

/// The least part of a bound that the best point must reach, so that bounds are not too wide.
constexpr double kReached = 0.4;

TEST_P(Bounds, OfKATimesAMinusOneHoldAtEveryPoint) {
  MovingInverse inverse(q_, moving_);
  const std::size_t n = q_.columns;
  double most = 0.0;
  for (int trial = 0; trial < 100; ++trial) {
    choose_box();
    ASSERT_TRUE(inverse.run(thin_, middle_, r_));
    for (int sample = 0; sample < 20; ++sample) {
      const Box at = choose_point(thin_);
      BallMatrix A(q_.rows, n), K(n, q_.rows), E(n, n);
      evaluate_matrix(at, A);
      moving_K(inverse, at, K);
      arb_mat_mul(E.get(), K.get(), A.get(), kBits);
      for (std::size_t i = 0; i < n; ++i) {
        arb_sub_ui(E.at(i, i), E.at(i, i), 1, kBits);
        for (std::size_t j = 0; j < n; ++j)
          most = std::max(most, compare(E.at(i, j), inverse.P()[j * n + i]));
      }
    }
  }
  EXPECT_GT(most, kReached);
}

TEST_P(Bounds, OfTheRowsThatQuantitiesTouchHoldAtEveryPoint) {
  MovingInverse inverse(q_, moving_);
  TouchedRows rows(q_, variety_, moving_);
  Domination domination(q_.columns);
  const std::size_t n = q_.columns;
  std::vector<std::size_t> touched(GetParam() == 1 ? 2 : GetParam() == 2 ? 3 : 0);
  std::iota(touched.begin(), touched.end(), std::size_t{0});
  ASSERT_EQ(rows.order(), touched.size());
  double most = touched.empty() ? 1.0 : 0.0;
  for (int trial = 0; trial < 100; ++trial) {
    choose_box();
    ASSERT_TRUE(inverse.run(thin_, middle_, r_));
    if (!domination.find(inverse.P())) continue;
    ASSERT_TRUE(rows.run(box_, middle_, r_, inverse, domination));
    for (int sample = 0; sample < 20; ++sample) {
      const Box at = choose_point(box_);
      Box at_middle = at;
      for (std::size_t k = 0; k < at.size(); ++k)
        if (std::find(moving_.begin(), moving_.end(), k) == moving_.end())
          at_middle[k] = middle_[k];
      BallMatrix A(q_.rows, n), B(q_.rows, n), K(n, q_.rows), E(n, n), inverse_of_E(n, n);
      BallMatrix x(n, q_.rows), F(q_.rows, q_.rows);
      evaluate_matrix(at, A);
      evaluate_matrix(at_middle, B);
      moving_K(inverse, at, K);
      arb_mat_mul(E.get(), K.get(), B.get(), kBits);  // I + E
      ASSERT_TRUE(arb_mat_inv(inverse_of_E.get(), E.get(), kBits));
      arb_mat_sub(A.get(), A.get(), B.get(), kBits);
      arb_mat_mul(x.get(), inverse_of_E.get(), K.get(), kBits);
      arb_mat_mul(F.get(), A.get(), x.get(), kBits);
      for (std::size_t s = 0; s < touched.size(); ++s)
        for (std::size_t c = 0; c < touched.size(); ++c)
          most =
              std::max(most, compare(F.at(touched[s], touched[c]), rows.T()[c * rows.order() + s]));
    }
  }
  EXPECT_GT(most, kReached);
}

INSTANTIATE_TEST_SUITE_P(Questions, Bounds, ::testing::Values(0, 1, 2));

TEST(ASolutionOfDominatedEquations, IsBounded) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform;
  for (int trial = 0; trial < 200; ++trial) {
    const std::size_t n = 1 + std::size_t(trial) % 6;
    Matrix T(n * n);
    for (double& x : T) x = uniform(random) * 1.1 / double(n);
    Domination domination(n);
    if (!domination.find(T)) continue;
    std::vector<double> c(n), x(n);
    for (double& entry : c) entry = uniform(random);
    domination.bound_solution(c.data(), x.data());
    BallMatrix M(n, n), right(n, 1), exact(n, 1);
    for (std::size_t i = 0; i < n; ++i) {
      arb_set_d(right.at(i, 0), c[i]);
      for (std::size_t j = 0; j < n; ++j) {
        arb_set_d(M.at(i, j), -T[j * n + i]);
        if (i == j) arb_add_ui(M.at(i, j), M.at(i, j), 1, kBits);
      }
    }
    ASSERT_TRUE(arb_mat_solve(exact.get(), M.get(), right.get(), kBits));
    for (std::size_t i = 0; i < n; ++i)
      EXPECT_TRUE(arb_le(exact.at(i, 0), Ball(point(x[i]), kBits).get()));
  }
}

}  // namespace
}  // namespace regulus::detail::test
