// SPDX-License-Identifier: GPL-3.0-or-later
// A hand-written kernel of a Gough platform. With moments about the origin, row i of the matrix is
// (d, a × (X + Rb)), d = X + Rb − a. A unimodular column operation turns it into Eq. (6) of Merlet,
// T-RO 2007. It is affine in x, y, z and the entries of R, so each entry of K·A and each of its
// derivatives is one affine form in these twelve.
#pragma once

#include "tests/support/fixture_kernel.hpp"

namespace regulus::detail::test {

using Anchors = std::array<std::array<double, 3>, 6>;

struct Gough {
  Anchors base;
  Anchors platform;
};

/// Robot 1 of Table III.
inline constexpr Gough kRobot1{
    {{{-9, 9, 0}, {9, 9, 0}, {12, -3, 0}, {3, -13, 0}, {-3, -13, 0}, {-12, -3, 0}}},
    {{{-3, 7, 0}, {3, 7, 0}, {7, -1, 0}, {4, -6, 0}, {-4, -6, 0}, {-7, -1, 0}}}};
inline constexpr Gough kRobot2{{{{-2539, 1778, 0},
                                 {2539, 1778, 500},
                                 {2809, 1310, 0},
                                 {270, -3088, 500},
                                 {-270, -3088, 0},
                                 {-2809, 1310, 500}}},
                               {{{-657, -239, -100},
                                 {657, -239, 100},
                                 {121, 689, -100},
                                 {-536, -449, 100},
                                 {536, -449, -100},
                                 {-121, 689, 100}}}};

/// Variables x y z ψ θ φ; R = Rz(ψ)·Rx(θ)·Rz(φ).
class GoughKernel : public FixtureKernel {
 public:
  explicit GoughKernel(const Gough& robot) : FixtureKernel(6, 6, 6, 6), robot_(robot) {
    enable_derivatives();
    enable_row_scale();
  }

  Values matrix(const Values& x) const override {
    const Terms terms = values(x);
    Values A(36);
    for (std::size_t p = 0; p < 6; ++p)
      for (std::size_t j = 0; j < 6; ++j) {
        const Form form = row_entry(p, j);
        A[p * 6 + j] = evaluate(form, terms);
      }
    return A;
  }

  Values left_product(const Values& x, std::span<const double> K) const override {
    return combine(values(x), K);
  }

  Values matrix_derivatives(const Values& x) const override {
    std::vector<double> identity(36, 0.0);
    for (std::size_t i = 0; i < 6; ++i) identity[7 * i] = 1.0;
    return left_derivatives(x, identity);
  }

  Values left_derivatives(const Values& x, std::span<const double> K) const override {
    Values out;
    for (std::size_t k = 0; k < 6; ++k) {
      const Values one = combine(derivative(x, k), K);
      out.insert(out.end(), one.begin(), one.end());
    }
    return out;
  }

  /// Returns ∏ 1/ρᵢ.
  Values row_scale(const Values& x) const override {
    const Values A = matrix(x);
    Interval product(1.0);
    for (std::size_t p = 0; p < 6; ++p)
      product *= sqrt(sqr(A[p * 6]) + sqr(A[p * 6 + 1]) + sqr(A[p * 6 + 2]));
    return {Interval(1.0) / product};
  }

 private:
  /// x, y, z, R row-major, 1.
  using Terms = std::array<Interval, 13>;
  using Form = std::array<Interval, 13>;

  static Interval evaluate(const Form& form, const Terms& terms) {
    Interval sum(0.0);
    for (std::size_t t = 0; t < 13; ++t) sum += form[t] * terms[t];
    return sum;
  }

  static Terms values(const Values& x) {
    const Interval cp = cos(x[3]), sp = sin(x[3]), ct = cos(x[4]), st = sin(x[4]);
    const Interval cf = cos(x[5]), sf = sin(x[5]);
    return {x[0],
            x[1],
            x[2],
            cp * cf - sp * ct * sf,
            -(cp * sf) - sp * ct * cf,
            sp * st,
            sp * cf + cp * ct * sf,
            cp * ct * cf - sp * sf,
            -(cp * st),
            st * sf,
            st * cf,
            ct,
            Interval(1.0)};
  }

  static Terms derivative(const Values& x, std::size_t k) {
    if (k == 3) return derivative_to_psi(x);
    if (k == 4) return derivative_to_theta(x);
    if (k == 5) return derivative_to_phi(x);
    Terms d;
    d.fill(Interval(0.0));
    d[k] = Interval(1.0);
    return d;
  }

  static Terms derivative_to_psi(const Values& x) {
    const Interval z(0.0), cp = cos(x[3]), sp = sin(x[3]), ct = cos(x[4]), st = sin(x[4]);
    const Interval cf = cos(x[5]), sf = sin(x[5]);
    return {z,
            z,
            z,
            -(sp * cf) - cp * ct * sf,
            sp * sf - cp * ct * cf,
            cp * st,
            cp * cf - sp * ct * sf,
            -(sp * ct * cf) - cp * sf,
            sp * st,
            z,
            z,
            z,
            z};
  }

  static Terms derivative_to_theta(const Values& x) {
    const Interval z(0.0), cp = cos(x[3]), sp = sin(x[3]), ct = cos(x[4]), st = sin(x[4]);
    const Interval cf = cos(x[5]), sf = sin(x[5]);
    return {z,
            z,
            z,
            sp * st * sf,
            sp * st * cf,
            sp * ct,
            -(cp * st * sf),
            -(cp * st * cf),
            -(cp * ct),
            ct * sf,
            ct * cf,
            -st,
            z};
  }

  static Terms derivative_to_phi(const Values& x) {
    const Interval z(0.0), cp = cos(x[3]), sp = sin(x[3]), ct = cos(x[4]), st = sin(x[4]);
    const Interval cf = cos(x[5]), sf = sin(x[5]);
    return {z,
            z,
            z,
            -(cp * sf) - sp * ct * cf,
            sp * ct * sf - cp * cf,
            z,
            cp * ct * cf - sp * sf,
            -(cp * ct * sf) - sp * cf,
            z,
            st * cf,
            -(st * sf),
            z,
            z};
  }

  /// Returns entry j of row p as a form: 0…2 are d, 3…5 are a × (X + Rb).
  [[nodiscard]] Form row_entry(std::size_t p, std::size_t j) const {
    Form form;
    form.fill(Interval(0.0));
    const auto& a = robot_.base[p];
    const auto add_point = [&](std::size_t axis, double factor) {
      form[axis] += Interval(factor);
      for (std::size_t c = 0; c < 3; ++c)
        form[3 + 3 * axis + c] += Interval(factor) * Interval(robot_.platform[p][c]);
    };
    if (j < 3) {
      add_point(j, 1.0);
      form[12] = Interval(-a[j]);
      return form;
    }
    const std::size_t next = (j - 2) % 3, after = (j - 1) % 3;
    add_point(after, a[next]);
    add_point(next, -a[after]);
    return form;
  }

  [[nodiscard]] Values combine(const Terms& terms, std::span<const double> K) const {
    Values out(36);
    std::array<Form, 36> rows;
    for (std::size_t p = 0; p < 6; ++p)
      for (std::size_t j = 0; j < 6; ++j) rows[p * 6 + j] = row_entry(p, j);
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) {
        Form form;
        form.fill(Interval(0.0));
        for (std::size_t p = 0; p < 6; ++p)
          for (std::size_t t = 0; t < 13; ++t)
            form[t] += Interval(K[i * 6 + p]) * rows[p * 6 + j][t];
        out[i * 6 + j] = evaluate(form, terms);
      }
    return out;
  }

  Gough robot_;
};

/// The range ±degrees in rad: an interval that contains it and an interval inside it.
struct Angle {
  Interval outer;
  Interval inner;
};
inline Angle plus_minus_degrees(double degrees) {
  const Interval radians = Interval(degrees) * kPi / Interval(180.0);
  return {{-radians.hi, radians.hi}, {-radians.lo, radians.lo}};
}

}  // namespace regulus::detail::test
