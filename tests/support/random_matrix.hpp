// SPDX-License-Identifier: GPL-3.0-or-later
// Random matrix functions whose exact values are cheap to compute.
#pragma once

#include <utility>

#include "tests/support/fixture_kernel.hpp"
#include "tests/support/lane_arrays.hpp"

namespace regulus::detail::test {

/// Entries are c₀ + Σ cₖxₖ + Σ dₖxₖ² + e·x₀x₁ with coefficients of a few bits, so that exact
/// arithmetic on doubles is cheap.
class RandomMatrix : public FixtureKernel {
 public:
  RandomMatrix(Random& random, unsigned variables, unsigned rows, unsigned columns, double diagonal)
      : FixtureKernel(variables, variables, rows, columns) {
    for (unsigned i = 0; i < rows; ++i)
      for (unsigned j = 0; j < columns; ++j) {
        std::vector<double> c;
        for (unsigned k = 0; k < terms(); ++k) c.push_back(random.one_in(2) ? small(random) : 0.0);
        if (i == j) c[0] += diagonal;
        coefficients_.push_back(c);
      }
  }

  void use_derivatives() { enable_derivatives(); }
  /// Lets the variable appear in one row only.
  void confine(unsigned variable, unsigned row) {
    const unsigned n = get()->variables;
    for (unsigned e = 0; e < coefficients_.size(); ++e) {
      if (e / get()->columns == row) continue;
      coefficients_[e][1 + variable] = coefficients_[e][1 + n + variable] = 0.0;
      if (variable < 2) coefficients_[e][1 + 2 * n] = 0.0;
    }
  }
  void constrain(std::vector<double> center, double radius, bool inside) {
    center_ = std::move(center);
    radius_ = radius;
    inside_ = inside;
    enable_constraints(1);
  }

  Values matrix(const Values& x) const override { return entries(x); }

  Values matrix_derivatives(const Values& x) const override {
    Values D;
    for (std::size_t k = 0; k < get()->variables; ++k)
      for (const auto& c : coefficients_) D.push_back(derivative(c, x, k));
    return D;
  }

  /// Returns the constraint of a ball: the inside or the outside of it.
  Values constraint(const Values& x) const override { return {constraint_at(x)}; }
  template <typename Number>
  [[nodiscard]] Number constraint_at(const std::vector<Number>& x) const {
    Number sum(0.0);
    for (std::size_t k = 0; k < x.size(); ++k) {
      const Number d = x[k] - Number(center_[k]);
      sum = sum + d * d;
    }
    const Number square(radius_ * radius_);
    return inside_ ? sum - square : square - sum;
  }
  [[nodiscard]] bool constrained() const { return !center_.empty(); }

  template <typename Number>
  [[nodiscard]] std::vector<Number> entries(const std::vector<Number>& x) const {
    std::vector<Number> A;
    for (const auto& c : coefficients_) {
      Number sum(c[0]);
      const std::size_t n = x.size();
      for (std::size_t k = 0; k < n; ++k)
        sum = sum + Number(c[1 + k]) * x[k] + Number(c[1 + n + k]) * x[k] * x[k];
      if (n > 1) sum = sum + Number(c[1 + 2 * n]) * x[0] * x[1];
      A.push_back(sum);
    }
    return A;
  }

 private:
  [[nodiscard]] unsigned terms() const { return 2 + 2 * get()->variables; }
  static double small(Random& random) {
    return std::ldexp(static_cast<double>(random.below(33)) - 16.0, -4);
  }
  static Interval derivative(const std::vector<double>& c, const Values& x, std::size_t k) {
    const std::size_t n = x.size();
    Interval sum = Interval(c[1 + k]) + Interval(2 * c[1 + n + k]) * x[k];
    if (n > 1 && k < 2) sum += Interval(c[1 + 2 * n]) * x[1 - k];
    return sum;
  }

  std::vector<std::vector<double>> coefficients_;
  std::vector<double> center_;
  double radius_ = 0.0;
  bool inside_ = true;
};

}  // namespace regulus::detail::test
