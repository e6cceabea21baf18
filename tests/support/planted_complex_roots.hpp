// SPDX-License-Identifier: GPL-3.0-or-later
// Systems of polynomials with real coefficients all of whose complex roots are known exactly.
#pragma once

#include <gtest/gtest.h>

#include "runtime/solutions/complex_root.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail::test {

/// Equation i is Π_k (u_i − r_ik) = 0 with u_i = z_i + Σ_{j<i} m_ij z_j. The r_ik are dyadic, real or
/// in conjugate pairs; some are equal, others 2^-27 apart.
class PlantedComplexRoots final : public PolynomialSystem {
 public:
  explicit PlantedComplexRoots(RandomSource& random) : factors_(1 + random.below(3)) {
    for (auto& factors : factors_)
      for (std::size_t k = 0, n = 1 + random.below(3); k < n; ++k) add_factor(random, factors);
    for (std::size_t e = 0; e < size() * size(); ++e)
      mixing_.push_back(static_cast<double>(random.below(7)) - 3);
  }

  [[nodiscard]] std::size_t size() const noexcept override { return factors_.size(); }

  void enclose(std::span<const Rectangle> z, std::span<Rectangle> values,
               std::span<Rectangle> derivatives) const override {
    for (std::size_t i = 0; i < size(); ++i) {
      Rectangle u = z[i], value(1.0), slope(0.0);
      for (std::size_t j = 0; j < i; ++j) u += Rectangle(mixing_[i * size() + j]) * z[j];
      for (const Factor& factor : factors_[i]) {
        const Rectangle shifted = u - Rectangle(factor.re);
        const bool is_pair = factor.im != 0;
        const Rectangle is =
            is_pair ? shifted * shifted + Rectangle(factor.im * factor.im) : shifted;
        slope = slope * is + value * (is_pair ? Rectangle(2.0) * shifted : Rectangle(1.0));
        value = value * is;
      }
      values[i] = value;
      for (std::size_t j = 0; j < size(); ++j)
        derivatives[i * size() + j] = j < i    ? Rectangle(mixing_[i * size() + j]) * slope
                                      : j == i ? slope
                                               : Rectangle(0.0);
    }
  }

  struct Root {
    std::vector<Complex> place;
    bool is_simple = true, is_real = true;
  };

  [[nodiscard]] std::vector<Root> roots() const {
    std::vector<Root> result{{}};
    for (std::size_t i = 0; i < size(); ++i) {
      std::vector<Root> longer;
      for (const Root& root : result)
        for (std::size_t k = 0; k < factors_[i].size(); ++k) {
          const Factor& factor = factors_[i][k];
          const auto same = std::ranges::count(factors_[i], factor);
          for (const double sign : factor.im != 0 ? std::vector{1.0, -1.0} : std::vector{1.0}) {
            Complex z(factor.re, sign * factor.im);
            for (std::size_t j = 0; j < i; ++j)
              z -= Complex(mixing_[i * size() + j]) * root.place[j];
            longer.push_back(root);
            longer.back().place.push_back(z);
            longer.back().is_simple &= same == 1;
            longer.back().is_real &= factor.im == 0;
          }
        }
      result = std::move(longer);
    }
    return result;
  }

 private:
  /// A root or, if im is not 0, a pair.
  struct Factor {
    double re = 0, im = 0;
    friend bool operator==(const Factor&, const Factor&) = default;
  };

  static void add_factor(RandomSource& random, std::vector<Factor>& to) {
    const auto eighths = [&] { return static_cast<double>(random.below(33)) / 8 - 2; };
    Factor factor{eighths(), random.one_in(2) ? 0 : std::abs(eighths())};
    if (!to.empty() && random.one_in(3)) {
      factor = to.back();
      if (random.one_in(2)) factor.re += 0x1p-27;
    }
    if (random.one_in(8)) factor.im = 0x1p-27;
    to.push_back(factor);
  }

  std::vector<std::vector<Factor>> factors_;
  std::vector<double> mixing_;
};

/// Ensures   each box that is certified has one root, which is simple, and real if it says so.
inline void expect_no_false_root(std::uint64_t seed, std::size_t cases) {
  RandomSource random(seed);
  std::size_t certified = 0, refused = 0;
  for (std::size_t number = 0; number < cases; ++number) {
    const PlantedComplexRoots system(random);
    const auto roots = system.roots();
    auto near = roots[random.below(roots.size())].place;
    const double noise = std::ldexp(1.0, -static_cast<int>(random.below(40)));
    for (Complex& z : near)
      z += Complex(noise * random.between(-1, 1),
                   random.one_in(2) ? 0 : noise * random.between(-1, 1));
    const auto box = certify_root(system, near);
    ++(box ? certified : refused);
    if (!box) continue;
    std::size_t inside = 0, perhaps = 0;
    for (const auto& root : roots) {
      bool is_inside = true, may_be_inside = true;
      for (std::size_t i = 0; i < system.size(); ++i) {
        const Rectangle distance = Rectangle(root.place[i]) - Rectangle(box->center[i]);
        is_inside &= std::max(mag(distance.re), mag(distance.im)) <= box->radius[i];
        may_be_inside &= std::max(mig(distance.re), mig(distance.im)) <= box->radius[i];
      }
      inside += is_inside, perhaps += may_be_inside;
      if (!is_inside) continue;
      EXPECT_TRUE(root.is_simple) << "case " << number;
      EXPECT_EQ(root.is_real, box->is_real) << "case " << number;
    }
    ASSERT_LE(inside, 1U) << "case " << number;
    ASSERT_GE(perhaps, 1U) << "case " << number;
  }
  EXPECT_GT(certified, cases / 4);
  EXPECT_GT(refused, cases / 20);
}

}  // namespace regulus::detail::test
