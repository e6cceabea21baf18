// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/oracle/planar_count.hpp"

#include <flint/fmpq_poly.h>
#include <flint/fmpz_poly.h>

#include <utility>

namespace regulus::detail::attack {
namespace {

class Polynomial {
 public:
  Polynomial() { fmpq_poly_init(p_); }
  /// a + bt + ct².
  Polynomial(const Rational& a, const Rational& b, const Rational& c) : Polynomial() {
    fmpq_poly_set_coeff_fmpq(p_, 0, a.get());
    fmpq_poly_set_coeff_fmpq(p_, 1, b.get());
    fmpq_poly_set_coeff_fmpq(p_, 2, c.get());
  }
  Polynomial(const Polynomial& other) : Polynomial() { fmpq_poly_set(p_, other.p_); }
  Polynomial& operator=(const Polynomial& other) {
    fmpq_poly_set(p_, other.p_);
    return *this;
  }
  ~Polynomial() { fmpq_poly_clear(p_); }

  [[nodiscard]] long degree() const { return fmpq_poly_degree(p_); }
  [[nodiscard]] const fmpq_poly_struct* get() const { return p_; }
  [[nodiscard]] fmpq_poly_struct* get() { return p_; }

  friend Polynomial operator+(const Polynomial& a, const Polynomial& b) {
    Polynomial r;
    fmpq_poly_add(r.p_, a.p_, b.p_);
    return r;
  }
  friend Polynomial operator-(const Polynomial& a, const Polynomial& b) {
    Polynomial r;
    fmpq_poly_sub(r.p_, a.p_, b.p_);
    return r;
  }
  friend Polynomial operator*(const Polynomial& a, const Polynomial& b) {
    Polynomial r;
    fmpq_poly_mul(r.p_, a.p_, b.p_);
    return r;
  }

 private:
  fmpq_poly_t p_;
};

Polynomial gcd(const Polynomial& a, const Polynomial& b) {
  Polynomial r;
  fmpq_poly_gcd(r.get(), a.get(), b.get());
  return r;
}

Polynomial quotient(const Polynomial& a, const Polynomial& b) {
  Polynomial r;
  fmpq_poly_div(r.get(), a.get(), b.get());
  return r;
}

Polynomial derivative(const Polynomial& a) {
  Polynomial r;
  fmpq_poly_derivative(r.get(), a.get());
  return r;
}

/// The number of different real roots.
std::size_t real_roots(const Polynomial& a) {
  if (a.degree() < 1) return 0;
  const Polynomial simple = quotient(a, gcd(a, derivative(a)));
  fmpz_poly_t whole;
  fmpz_poly_init(whole);
  fmpq_poly_get_numerator(whole, simple.get());
  const slong count = fmpz_poly_num_real_roots(whole);
  fmpz_poly_clear(whole);
  return static_cast<std::size_t>(count);
}

}  // namespace

PlanarCount count_planar_poses(const PlanarPlatform& robot) {
  const Rational one(1), zero(0), two(2);
  const Polynomial norm(one, zero, one), twice(two, zero, zero);
  // All times 1 + t²: the vector u from an anchor of the base to that of the platform at the origin,
  // and w = |u|² − l². Then |p|² + 2u·p + w = 0.
  std::array<Polynomial, 3> ux, uy, w;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& [ax, ay] = robot.base[i];
    const auto& [bx, by] = robot.platform[i];
    ux[i] = Polynomial(bx - ax, -two * by, -bx - ax);
    uy[i] = Polynomial(by - ay, two * bx, -by - ay);
    const Rational sum = ax * ax + ay * ay + bx * bx + by * by - robot.squares[i];
    const Rational cosine = -two * (ax * bx + ay * by), sine = -two * (ay * bx - ax * by);
    w[i] = Polynomial(sum + cosine, two * sine, sum - cosine);
  }
  const Polynomial a1 = twice * (ux[1] - ux[0]), b1 = twice * (uy[1] - uy[0]), c1 = w[0] - w[1];
  const Polynomial a2 = twice * (ux[2] - ux[0]), b2 = twice * (uy[2] - uy[0]), c2 = w[0] - w[2];
  const Polynomial det = a1 * b2 - a2 * b1, x = c1 * b2 - c2 * b1, y = a1 * c2 - a2 * c1;
  Polynomial rest =
      (x * x + y * y) * norm + twice * det * (ux[0] * x + uy[0] * y) + w[0] * det * det;
  constexpr long kFullDegree = 10;
  if (rest.degree() != kFullDegree) return {};  // φ = π is a root, or all angles are
  const Polynomial again = gcd(rest, derivative(rest));
  if (real_roots(gcd(rest, det)) > 0) return {};
  PlanarCount count;
  count.is_multiple = real_roots(again) > 0;
  count.poses = real_roots(rest);
  return count;
}

}  // namespace regulus::detail::attack
