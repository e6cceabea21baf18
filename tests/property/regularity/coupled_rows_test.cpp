// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices with two groups of uncertain quantities in each row, and their products: I + Σ_l e_l
// (X_lᵀs_l + Y_lᵀt_l + Σ_ij t_j s_i Z_lji)ᵀ, with s_l and t_l in boxes or in balls.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/regularity/orthants.hpp"
#include "tests/support/exact.hpp"
#include "tests/support/lane_arrays.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail {
namespace {

using namespace test;
using Kind = OrthantProblem::Term::Kind;

class CoupledRows {
 public:
  CoupledRows(Random& random, Kind kind, double curvature)
      : kind_(kind),
        n_(2 + static_cast<unsigned>(random.below(2))),
        first_(1 + static_cast<unsigned>(random.below(kind == Kind::kBalls ? 3 : 2))),
        second_(1 + static_cast<unsigned>(random.below(kind == Kind::kBalls ? 3 : 2))),
        forms_(first_ + second_ + first_ * second_),
        x_(n_ * forms_ * n_) {
    for (std::size_t e = 0; e < x_.size(); ++e)
      x_[e] = uniform(random, -1, 1) * (e / n_ % forms_ < first_ + second_ ? 1.0 : curvature);
  }

  [[nodiscard]] unsigned order() const { return n_; }
  /// Returns how many of s and t each row has.
  [[nodiscard]] unsigned quantities() const { return first_ + second_; }

  [[nodiscard]] OrthantProblem problem(double range) const {
    OrthantProblem p;
    p.rows = p.terms = n_;
    for (unsigned l = 0; l <= n_; ++l) p.first_term[l] = l;
    for (unsigned l = 0; l < n_; ++l) {
      p.term[l] = {l * forms_, (l + 1) * forms_, 1.0, kind_, first_, second_};
      p.scale[l] = 1.0;
      for (unsigned j = 0; j < n_; ++j) {
        double reach = 0.0;
        for (unsigned k = 0; k < forms_; ++k) {
          const double scale = k < first_ + second_ ? range : range * range;
          double& form = p.form[(l * forms_ + k) * n_ + j];
          form = scale * coefficient(l, k, j);
          reach += std::fabs(form);
        }
        p.reach[l * n_ + j] = raise_ru(reach, raise_factor(forms_));
        p.slack[l * n_ + j] = 0x1p-40;
      }
    }
    return p;
  }

  /// `u`: s and t of each row.
  template <typename Number>
  [[nodiscard]] std::vector<Number> at(const std::vector<double>& u) const {
    std::vector<Number> A;
    for (unsigned l = 0; l < n_; ++l) {
      const double* const s = u.data() + l * quantities();
      const double* const t = s + first_;
      for (unsigned j = 0; j < n_; ++j) {
        Number sum(l == j ? 1.0 : 0.0);
        for (unsigned i = 0; i < quantities(); ++i)
          sum = sum + Number(s[i]) * Number(coefficient(l, i, j));
        for (unsigned b = 0; b < second_; ++b)
          for (unsigned a = 0; a < first_; ++a)
            sum = sum + Number(t[b]) * Number(s[a]) *
                            Number(coefficient(l, first_ + second_ + b * first_ + a, j));
        A.push_back(sum);
      }
    }
    return A;
  }

  [[nodiscard]] bool is_singular_or_beyond(const std::vector<double>& u) const {
    return determinant(at<Exact>(u), n_).sign() <= 0;
  }

  /// The determinant is affine in each s_l and t_l: moves one after the other to where it is least.
  void descend(std::vector<double>& u, double range) const {
    for (int round = 0; round < 12; ++round)
      for (unsigned l = 0; l < n_; ++l)
        for (const auto& [begin, size] : {std::pair(0U, first_), std::pair(first_, second_)})
          move_to_least(u.data() + l * quantities() + begin, size, range, u);
  }

 private:
  [[nodiscard]] double coefficient(unsigned l, unsigned form, unsigned j) const {
    return x_[(l * forms_ + form) * n_ + j];
  }

  [[nodiscard]] double approx_determinant(const std::vector<double>& u) const {
    std::vector<double> A = at<double>(u);
    double result = 1.0;
    for (unsigned k = 0; k < n_; ++k) {
      unsigned pivot = k;
      for (unsigned i = k + 1; i < n_; ++i)
        if (std::fabs(A[i * n_ + k]) > std::fabs(A[pivot * n_ + k])) pivot = i;
      if (A[pivot * n_ + k] == 0.0) return 0.0;
      if (pivot != k) result = -result;
      for (unsigned j = 0; j < n_; ++j) std::swap(A[pivot * n_ + j], A[k * n_ + j]);
      result *= A[k * n_ + k];
      for (unsigned i = k + 1; i < n_; ++i)
        for (unsigned j = n_; j-- > k;)
          A[i * n_ + j] -= A[i * n_ + k] / A[k * n_ + k] * A[k * n_ + j];
    }
    return result;
  }

  void move_to_least(double* part, unsigned size, double range, std::vector<double>& u) const {
    double gradient[kMaxCoupled] = {}, squares = 0.0;
    std::fill_n(part, size, 0.0);
    const double before = approx_determinant(u);
    for (unsigned i = 0; i < size; ++i) {
      part[i] = 1.0;
      gradient[i] = approx_determinant(u) - before;
      squares += gradient[i] * gradient[i];
      part[i] = 0.0;
    }
    const double length = range * (1.0 - 0x1p-40) / std::sqrt(squares);
    for (unsigned i = 0; i < size; ++i)
      part[i] = kind_ == Kind::kBalls ? -length * gradient[i] : gradient[i] > 0.0 ? -range : range;
  }

  const Kind kind_;
  const unsigned n_, first_, second_, forms_;
  std::vector<double> x_;
};

class CoupledTerms : public testing::TestWithParam<Kind> {
 protected:
  /// Returns true if some geometry within `range` is singular.
  static bool find_singular(const CoupledRows& rows, double range, Random& random) {
    for (int start = 0; start < 40; ++start) {
      std::vector<double> u(rows.order() * rows.quantities());
      for (double& x : u) x = uniform(random, -range, range);
      rows.descend(u, range);
      if (rows.is_singular_or_beyond(u)) return true;
    }
    return false;
  }
};

TEST_P(CoupledTerms, ComeCloseToTheTruthAndNeverPassIt) {
  constexpr unsigned kHalvings = 2000;
  Random random(33);
  int close = 0, rounds = 0, passed = 0;
  for (; rounds < test::trials(5, 16); ++rounds) {
    const CoupledRows rows(random, GetParam(), std::ldexp(1.0, -static_cast<int>(random.below(4))));
    OrthantCell hint{};
    double range = 0.05;
    while (range < 4.0 && certain_orthants_empty(rows.problem(range), hint, kHalvings)) {
      ASSERT_FALSE(find_singular(rows, range, random)) << "round " << rounds << ", " << range;
      range *= 1.03;
      ++passed;
    }
    close += find_singular(rows, 1.04 * range, random);
  }
  std::printf("%d claims; %d of %d limits within 7 %% of the truth\n", passed, close, rounds);
  EXPECT_GT(passed, test::trials(150, 500));
  EXPECT_GE(close, GetParam() == Kind::kRanges ? rounds - 1 : rounds - 2);
}

TEST_P(CoupledTerms, AreEmptyWhateverTheHint) {
  Random random(34);
  int empty = 0, remaining = 0;
  for (int round = 0; round < 40; ++round) {
    const CoupledRows rows(random, GetParam(), 0.5);
    for (const unsigned halvings : {0U, 1U, 3U, 10U, 40U})
      for (double range = 0.3; range < 1.5; range *= 1.1) {
        const OrthantProblem problem = rows.problem(range);
        OrthantCell first{};
        const bool expected = certain_orthants_empty(problem, first, halvings);
        ++(expected ? empty : remaining);
        for (unsigned cell = 1; cell < rows.order() << (rows.order() - 1); ++cell) {
          OrthantCell hint{cell / rows.order(), cell % rows.order()};
          ASSERT_EQ(certain_orthants_empty(problem, hint, halvings), expected)
              << round << ", " << range << ", " << halvings << ", cell " << cell;
        }
      }
  }
  EXPECT_GT(empty, 100);
  EXPECT_GT(remaining, 100);
}

INSTANTIATE_TEST_SUITE_P(Shapes, CoupledTerms, testing::Values(Kind::kRanges, Kind::kBalls),
                         [](const auto& kind) {
                           return std::string(kind.param == Kind::kRanges ? "Ranges" : "Balls");
                         });

}  // namespace
}  // namespace regulus::detail
