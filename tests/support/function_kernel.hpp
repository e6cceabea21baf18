// SPDX-License-Identifier: GPL-3.0-or-later
// Kernels made from lambdas, and search problems with them.
#pragma once

#include <functional>
#include <utility>

#include "runtime/search/solver.hpp"
#include "tests/support/fixture_kernel.hpp"

namespace regulus::detail::test {

class FunctionKernel : public FixtureKernel {
 public:
  using Function = std::function<Values(const Values&)>;

  FunctionKernel(unsigned variables, unsigned rows, unsigned columns, Function matrix)
      : FixtureKernel(variables, variables, rows, columns), matrix_(std::move(matrix)) {}

  /// Makes the last `count` variables uncertain quantities.
  FunctionKernel& with_uncertain(unsigned count) {
    functions().motion_variables = functions().variables - count;
    functions().pose_parameters = functions().motion_variables;
    return *this;
  }
  /// Sets ∂_kA for each variable k, one after the other.
  FunctionKernel& with_derivatives(Function derivatives) {
    derivatives_ = std::move(derivatives);
    enable_derivatives();
    return *this;
  }
  FunctionKernel& with_row_scale(Function scale) {
    scale_ = std::move(scale);
    enable_row_scale();
    return *this;
  }
  FunctionKernel& with_constraints(unsigned count, Function constraint) {
    constraint_ = std::move(constraint);
    enable_constraints(count);
    return *this;
  }
  FunctionKernel& with_determinant(Function determinant) {
    determinant_ = std::move(determinant);
    enable_determinant();
    return *this;
  }
  FunctionKernel& with_determinant_derivatives(Function derivatives) {
    determinant_derivatives_ = std::move(derivatives);
    enable_determinant_derivatives();
    return *this;
  }
  FunctionKernel& with_pose(unsigned count, Function pose) {
    pose_ = std::move(pose);
    functions().pose_parameters = count;
    return *this;
  }

  Values matrix(const Values& x) const override { return matrix_(x); }
  Values row_scale(const Values& x) const override { return scale_(x); }
  Values constraint(const Values& x) const override { return constraint_(x); }
  Values determinant(const Values& x) const override { return determinant_(x); }
  Values determinant_derivatives(const Values& x) const override {
    return determinant_derivatives_(x);
  }
  Values pose(const Values& x) const override { return pose_ ? pose_(x) : FixtureKernel::pose(x); }
  Values matrix_derivatives(const Values& x) const override { return derivatives_(x); }

 private:
  Function matrix_, derivatives_, scale_, constraint_, pose_, determinant_,
      determinant_derivatives_;
};

/// Returns a problem whose ranges end in doubles.
inline Problem problem_over(const FixtureKernel& kernel, const std::vector<Interval>& ranges,
                            Interval alpha = Interval(0.0)) {
  Problem problem;
  problem.kernel = kernel.get();
  problem.outer = ranges;
  problem.inner.assign(ranges.begin(), ranges.end());
  problem.alpha = alpha;
  return problem;
}

/// det = x² + y² - 1.
inline FunctionKernel singular_circle() {
  return {2, 2, 2, [](const Values& x) { return Values{x[0] + 1.0, x[1], -x[1], x[0] - 1.0}; }};
}

}  // namespace regulus::detail::test
