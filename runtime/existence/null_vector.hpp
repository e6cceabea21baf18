// SPDX-License-Identifier: Apache-2.0
// Singular for certain: a point where an m×n matrix A(t), m ≥ n, loses rank, and a null vector.
//
// Rank loss has codimension d = m − n + 1, so t has d variables. With one component of v fixed to 1,
// A(t)·v = 0 are m equations in m unknowns: t and the others of v. Krawczyk's test (branch_tube.hpp, with
// no variables) shows a solution in a box. Its v is not 0, so A is singular at its t. Where the system is
// not regular, as where a determinant only touches 0, the test fails.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "runtime/interval/interval.hpp"

namespace regulus::detail {

/// A over a box of t.
struct MatrixOverBox {
  std::vector<Interval> entries;  ///< m×n, row-major
  std::vector<Interval> slopes;   ///< ∂_kA, k by k: d·m·n
};

/// Encloses A and its derivatives over a box of t; nullopt unless A is certainly defined and continuously
/// differentiable on it.
using MatrixFunction = std::function<std::optional<MatrixOverBox>(std::span<const Interval>)>;

struct NullVectorBox {
  std::vector<Interval> t;       ///< d
  std::vector<Interval> vector;  ///< n; the component that was the largest is the number 1
};

/// Improves t and v by Newton's method, and encloses a solution next to them.
///
/// Shape     t, ranges: d = m − n + 1; v: n, not 0.
/// Ensures   A(t)·v = 0 for some t and v of the result, which is at most 1e-10 wide where t and v are
///           below 1000, and relative to that beyond it; its t is within `ranges`. nullopt: nothing is
///           known.
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] std::optional<NullVectorBox> enclose_null_vector(const MatrixFunction& matrix,
                                                               std::vector<double> t,
                                                               std::vector<double> v,
                                                               std::span<const Interval> ranges);

}  // namespace regulus::detail
