// SPDX-License-Identifier: Apache-2.0
// Calling a kernel: the floating-point environment it needs, and the contract of its inputs.
#pragma once

#include "regulus/kernel/abi.hpp"

namespace regulus {

/// One bit per lane.
inline constexpr unsigned kAllLanes = (1u << REGULUS_LANES) - 1;

/// The magnitudes a kernel may be given.
inline constexpr double kMaxBoxMagnitude = 0x1p64;
inline constexpr double kMaxPointMagnitude = 0x1p128;

/// Lanes in which an interval has a NaN, bounds in the wrong order, or |bound| > 2^64.
///
/// Shape     boxes as in regulus_function, `variables` of them.
[[nodiscard]] unsigned lanes_outside_contract(const double* boxes, unsigned variables) noexcept;

/// Lanes in which an entry of K is a NaN, or > 2^128 in magnitude, or a row is on no grid.
///
/// Shape     points as in regulus_function: `rows` rows of K with `length` entries each.
[[nodiscard]] unsigned point_lanes_outside_contract(const double* points, unsigned rows,
                                                    unsigned length) noexcept;

/// A kernel that has been looked at once and may then be called safely. It does not own the
/// functions; whoever loaded their code keeps it loaded.
class Kernel {
 public:
  /// Throws std::invalid_argument, saying what is wrong, when the ABI version or the rounding is
  /// unknown, a count is impossible, or there is no function `matrix`.
  explicit Kernel(const regulus_kernel& kernel);

  [[nodiscard]] const regulus_kernel& functions() const noexcept { return *kernel_; }

  /// Calls one of the kernel's functions on eight boxes.
  ///
  /// Shape     as in regulus_function. `points` is null, or has all entries of K.
  /// Ensures   the lanes in which nothing is known: those the function reports and those whose
  ///           inputs are outside the contract; all of them when `function` is null. In the other
  ///           lanes the outputs are enclosures. The caller's floating-point environment is kept.
  [[nodiscard]] unsigned call(regulus_function function, const double* boxes, const double* points,
                              double* out) const noexcept;

  /// The same for inputs that are known to be within the contract.
  ///
  /// Requires  `function` is not null; lanes_outside_contract(boxes) is 0, and that of the points.
  [[nodiscard]] unsigned call_within_contract(regulus_function function, const double* boxes,
                                              const double* points, double* out) const noexcept;

 private:
  const regulus_kernel* kernel_;
};

}  // namespace regulus
