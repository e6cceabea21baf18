// SPDX-License-Identifier: GPL-3.0-or-later
// Hand-written kernels over scalar intervals, for tests of the code that calls kernels.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "runtime/interval/interval.hpp"
#include "runtime/kernel/abi.hpp"

namespace regulus::detail::test {

using Values = std::vector<Interval>;

/// A regulus_kernel that calls the virtual functions of this class, lane by lane. A lane is
/// undefined if some output is unbounded. Products with K are computed from the matrix unless
/// overridden.
class FixtureKernel {
 public:
  FixtureKernel(unsigned variables, unsigned motion_variables, unsigned rows, unsigned columns);
  FixtureKernel(const FixtureKernel&) = delete;
  FixtureKernel& operator=(const FixtureKernel&) = delete;
  virtual ~FixtureKernel() = default;

  [[nodiscard]] const regulus_kernel* get() const { return &kernel_; }
  /// Allows a test to remove functions.
  [[nodiscard]] regulus_kernel& functions() { return kernel_; }

  [[nodiscard]] virtual Values matrix(const Values& x) const = 0;
  [[nodiscard]] virtual Values left_product(const Values& x, std::span<const double> K) const;
  [[nodiscard]] virtual Values right_product(const Values& x, std::span<const double> K) const;
  /// Returns ∂_kA for each variable k, one after the other; enable_derivatives needs it.
  [[nodiscard]] virtual Values matrix_derivatives(const Values&) const { return {}; }
  [[nodiscard]] virtual Values left_derivatives(const Values& x, std::span<const double> K) const;
  [[nodiscard]] virtual Values row_scale(const Values&) const { return {}; }
  [[nodiscard]] virtual Values constraint(const Values&) const { return {}; }
  [[nodiscard]] virtual Values determinant(const Values&) const { return {}; }
  [[nodiscard]] virtual Values determinant_derivatives(const Values&) const { return {}; }
  [[nodiscard]] virtual Values pose(const Values& x) const {
    return {x.begin(), x.begin() + kernel_.pose_parameters};
  }

 protected:
  void enable_derivatives();
  void enable_row_scale();
  void enable_constraints(unsigned count);
  void enable_determinant();
  void enable_determinant_derivatives();

 private:
  regulus_kernel kernel_{};
};

namespace adapters {

template <typename Function>
unsigned for_lanes(const double* boxes, double* out, const regulus_kernel& kernel,
                   Function&& function) {
  constexpr std::size_t lanes = REGULUS_LANES;
  unsigned undefined = 0;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    Values x(kernel.variables);
    for (std::size_t k = 0; k < x.size(); ++k)
      x[k] = {boxes[2 * k * lanes + lane], boxes[(2 * k + 1) * lanes + lane]};
    const Values y = function(x, lane);
    for (std::size_t e = 0; e < y.size(); ++e) {
      const bool bounded = is_bounded(y[e]);
      if (!bounded) undefined |= 1U << lane;
      out[2 * e * lanes + lane] = bounded ? y[e].lo : 0;
      out[(2 * e + 1) * lanes + lane] = bounded ? y[e].hi : 0;
    }
  }
  return undefined;
}

inline const FixtureKernel& self(const void* context) {
  return *static_cast<const FixtureKernel*>(context);
}

template <Values (FixtureKernel::*Function)(const Values&) const>
unsigned plain(const double* boxes, const double*, double* out, const void* context) {
  return for_lanes(boxes, out, *self(context).get(),
                   [&](const Values& x, std::size_t) { return (self(context).*Function)(x); });
}

template <Values (FixtureKernel::*Function)(const Values&, std::span<const double>) const>
unsigned with_points(const double* boxes, const double* points, double* out, const void* context) {
  const regulus_kernel& kernel = *self(context).get();
  return for_lanes(boxes, out, kernel, [&](const Values& x, std::size_t lane) {
    std::vector<double> K(std::size_t{kernel.rows} * kernel.columns);
    for (std::size_t p = 0; p < K.size(); ++p) K[p] = points[p * REGULUS_LANES + lane];
    return (self(context).*Function)(x, K);
  });
}

}  // namespace adapters

inline FixtureKernel::FixtureKernel(unsigned variables, unsigned motion_variables, unsigned rows,
                                    unsigned columns) {
  kernel_.abi = REGULUS_KERNEL_ABI;
  kernel_.rounding = REGULUS_ROUND_NEAREST;
  kernel_.variables = variables;
  kernel_.motion_variables = motion_variables;
  kernel_.rows = rows;
  kernel_.columns = columns;
  kernel_.pose_parameters = motion_variables;
  kernel_.matrix = adapters::plain<&FixtureKernel::matrix>;
  kernel_.left_product = adapters::with_points<&FixtureKernel::left_product>;
  if (rows == columns) kernel_.right_product = adapters::with_points<&FixtureKernel::right_product>;
  kernel_.pose = adapters::plain<&FixtureKernel::pose>;
  kernel_.context = this;
  kernel_.identity = "fixture";
}

inline void FixtureKernel::enable_derivatives() {
  kernel_.matrix_derivatives = adapters::plain<&FixtureKernel::matrix_derivatives>;
  kernel_.left_derivatives = adapters::with_points<&FixtureKernel::left_derivatives>;
}
inline void FixtureKernel::enable_row_scale() {
  kernel_.row_scale = adapters::plain<&FixtureKernel::row_scale>;
}
inline void FixtureKernel::enable_determinant() {
  kernel_.determinant = adapters::plain<&FixtureKernel::determinant>;
}
inline void FixtureKernel::enable_determinant_derivatives() {
  kernel_.determinant_derivatives = adapters::plain<&FixtureKernel::determinant_derivatives>;
}
inline void FixtureKernel::enable_constraints(unsigned count) {
  kernel_.constraints = count;
  kernel_.constraint = adapters::plain<&FixtureKernel::constraint>;
}

inline Values FixtureKernel::left_product(const Values& x, std::span<const double> K) const {
  const Values A = matrix(x);
  const std::size_t m = kernel_.rows, n = kernel_.columns;
  Values out(n * n, Interval(0.0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t p = 0; p < m; ++p) out[i * n + j] += Interval(K[i * m + p]) * A[p * n + j];
  return out;
}

inline Values FixtureKernel::left_derivatives(const Values& x, std::span<const double> K) const {
  const Values D = matrix_derivatives(x);
  const std::size_t m = kernel_.rows, n = kernel_.columns;
  Values out;
  for (std::size_t k = 0; k < kernel_.variables; ++k)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        Interval sum(0.0);
        for (std::size_t p = 0; p < m; ++p) sum += Interval(K[i * m + p]) * D[(k * m + p) * n + j];
        out.push_back(sum);
      }
  return out;
}

inline Values FixtureKernel::right_product(const Values& x, std::span<const double> K) const {
  const Values A = matrix(x);
  const std::size_t n = kernel_.columns;
  Values out(n * n, Interval(0.0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t p = 0; p < n; ++p) out[i * n + j] += A[i * n + p] * Interval(K[p * n + j]);
  return out;
}

}  // namespace regulus::detail::test
