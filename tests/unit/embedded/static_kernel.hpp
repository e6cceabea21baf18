// SPDX-License-Identifier: GPL-3.0-or-later
// Kernels as plain functions, without a heap, of motion parameters x, y and one uncertain u: A =
// [[x + u − r, y], [−y, x + u − r]], det A = (x + u − r)² + y²; and det A = x + u.
#pragma once

#include <cstddef>

#include "runtime/interval/interval.hpp"
#include "runtime/kernel/abi.hpp"

namespace regulus::detail::test {

inline Interval range(const double* boxes, std::size_t variable, std::size_t lane) {
  return {boxes[(2 * variable) * REGULUS_LANES + lane],
          boxes[(2 * variable + 1) * REGULUS_LANES + lane]};
}
inline void put(double* out, std::size_t entry, std::size_t lane, Interval x) {
  out[(2 * entry) * REGULUS_LANES + lane] = x.lo;
  out[(2 * entry + 1) * REGULUS_LANES + lane] = x.hi;
}

/// It is singular only at x + u = r and y = 0; the determinant does not change its sign there.
inline unsigned point_matrix(const double* boxes, const double*, double* out, const void* context) {
  const double r = *static_cast<const double*>(context);
  for (std::size_t lane = 0; lane < REGULUS_LANES; ++lane) {
    const Interval a = range(boxes, 0, lane) + range(boxes, 2, lane) - Interval(r);
    const Interval y = range(boxes, 1, lane);
    put(out, 0, lane, a);
    put(out, 1, lane, y);
    put(out, 2, lane, -y);
    put(out, 3, lane, a);
  }
  return 0;
}

inline unsigned line_matrix(const double* boxes, const double*, double* out, const void*) {
  for (std::size_t lane = 0; lane < REGULUS_LANES; ++lane)
    put(out, 0, lane, range(boxes, 0, lane) + range(boxes, 2, lane));
  return 0;
}

inline regulus_kernel static_kernel(regulus_function matrix, unsigned size, const double* r) {
  regulus_kernel kernel{};
  kernel.abi = REGULUS_KERNEL_ABI;
  kernel.rounding = REGULUS_ROUND_NEAREST;
  kernel.variables = 3;
  kernel.motion_variables = 2;
  kernel.rows = kernel.columns = size;
  kernel.matrix = matrix;
  kernel.context = r;
  kernel.identity = "static";
  return kernel;
}

}  // namespace regulus::detail::test
