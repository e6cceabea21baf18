// SPDX-License-Identifier: GPL-3.0-or-later
// Roots that are known exactly: simple ones are proved, double ones never, neighbours are told apart.
#include "runtime/verifier/complex_root.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace regulus::verifier {
namespace {

/// (z₀ − a)² + b and z₁ − z₀³, with real numbers: z₀ is a ± √−b.
class Pair final : public ComplexSystem {
 public:
  Pair(double a, double b) : a_(a), b_(b) {}

  [[nodiscard]] std::size_t unknowns() const override { return 2; }
  void evaluate(const ComplexMatrix& z, ComplexMatrix& values, ComplexMatrix& derivatives,
                long bits) const override {
    ComplexMatrix shift(3, 1);  // a, b, z₀ − a
    acb_set_d(shift.at(0), a_);
    acb_set_d(shift.at(1), b_);
    acb_sub(shift.at(2), z.at(0), shift.at(0), bits);
    acb_mul(values.at(0), shift.at(2), shift.at(2), bits);
    acb_add(values.at(0), values.at(0), shift.at(1), bits);
    acb_mul_ui(derivatives.at(0, 0), shift.at(2), 2, bits);
    acb_zero(derivatives.at(0, 1));
    acb_pow_ui(values.at(1), z.at(0), 3, bits);
    acb_sub(values.at(1), z.at(1), values.at(1), bits);
    acb_pow_ui(derivatives.at(1, 0), z.at(0), 2, bits);
    acb_mul_si(derivatives.at(1, 0), derivatives.at(1, 0), -3, bits);
    acb_one(derivatives.at(1, 1));
  }

 private:
  const double a_, b_;
};

ComplexMatrix place(double re, double im) {
  ComplexMatrix z(2, 1);
  acb_set_d_d(z.at(0), re, im);
  acb_pow_ui(z.at(1), z.at(0), 3, 64);
  acb_mat_get_mid(z.get(), z.get());
  return z;
}

constexpr std::array<double, 2> kScale{1, 1};
constexpr long kBits = 1024;

TEST(RootsOfAPair, AreProvedAndToldApartHoweverNear) {
  for (const int exponent : {0, -10, -30, -60, -100, -200}) {
    const double root = std::ldexp(1.0, exponent);
    const Pair real(1, -root * root), complex(1, root * root);
    for (const bool is_real_pair : {true, false}) {
      const Pair& system = is_real_pair ? real : complex;
      const auto at = [&](double sign) {
        ComplexMatrix z(2, 1);
        acb_set_d_d(z.at(0), is_real_pair ? sign * root : 0, is_real_pair ? 0 : sign * root);
        acb_add_ui(z.at(0), z.at(0), 1, kBits);
        acb_pow_ui(z.at(1), z.at(0), 3, kBits);
        return z;
      };
      const auto a = prove_root(system, at(1), kScale, kBits);
      const auto b = prove_root(system, at(-1), kScale, kBits);
      const auto again = prove_root(system, at(1), kScale, 2 * kBits);
      ASSERT_TRUE(a && b && again) << exponent;
      EXPECT_EQ(is_same(*a, *b), Certainty::kNo);
      EXPECT_EQ(is_same(*a, *again), Certainty::kYes);
      EXPECT_EQ(is_real(*a), is_real_pair ? Certainty::kYes : Certainty::kNo) << exponent;
      EXPECT_NE(acb_contains(a->enclosure().at(0), at(1).at(0)), 0);
    }
  }
}

TEST(ADoubleRoot, IsNeverProved) {
  for (const double off : {0.0, 1e-3, 1e-9, 1e-15})
    EXPECT_FALSE(prove_root(Pair(1, 0), place(1 + off, off / 2), kScale, kBits)) << off;
}

/// A real root that is approached from a complex place.
TEST(ARealRoot, IsRealFromAnyPlace) {
  for (const double im : {0.0, 1e-12, 1e-6, 0.1}) {
    const auto root = prove_root(Pair(0, -2), place(1.4, im), kScale, kBits);
    ASSERT_TRUE(root);
    EXPECT_EQ(is_real(*root), Certainty::kYes);
  }
}

}  // namespace
}  // namespace regulus::verifier
