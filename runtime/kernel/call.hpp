// SPDX-License-Identifier: Apache-2.0
// Calls a kernel: the floating-point environment that it needs, and the contract of its inputs.
#pragma once

#include <cstddef>

#include "runtime/interval/lanes.hpp"
#include "runtime/kernel/abi.hpp"

namespace regulus::detail {

static_assert(kLanes == REGULUS_LANES);

/// The largest magnitudes that a kernel may receive.
inline constexpr double kMaxBoxMagnitude = 0x1p64;
inline constexpr double kMaxPointMagnitude = 0x1p128;

/// The outputs of an undefined lane are set to this after each call: an enclosure of all numbers,
/// from which nothing follows. It is the same for every engine and instruction set.
inline constexpr double kUndefinedLower = -__builtin_inf();
inline constexpr double kUndefinedUpper = __builtin_inf();

/// Returns lanes in which an interval has a NaN, bounds in the wrong order, or |bound| > 2^64.
///
/// Shape     boxes as in regulus_function, `variables` of them.
[[nodiscard]] LaneMask lanes_outside_contract(const double* boxes, unsigned variables) noexcept;

/// Returns lanes in which an entry of K is NaN or > 2^128 in magnitude, or a row is on no grid.
///
/// Shape     points as in regulus_function: `rows` rows of K with `length` entries each.
[[nodiscard]] LaneMask point_lanes_outside_contract(const double* points, unsigned rows,
                                                    unsigned length) noexcept;

/// A kernel that has been checked once and may then be called safely. It does not own the
/// functions; the owner of their code keeps it loaded.
class CheckedKernel {
 public:
  /// Throws std::invalid_argument, with the reason, if the ABI version or the rounding is unknown,
  /// a count is impossible, or there is no function `matrix`.
  explicit CheckedKernel(const regulus_kernel& kernel);

  [[nodiscard]] const regulus_kernel& functions() const noexcept { return *kernel_; }

  /// Calls one of the kernel's functions on eight boxes.
  ///
  /// Shape     as in regulus_function. `points` is null, or has all entries of K.
  /// Ensures   the lanes in which nothing is known: those that the function reports, and those
  ///           whose inputs are outside the contract; all if `function` is null. In the other lanes
  ///           the outputs are enclosures; in these they are [−∞, ∞] if the function is one of the
  ///           kernel's. The caller's floating-point environment is kept.
  [[nodiscard]] LaneMask call(regulus_function function, const double* boxes, const double* points,
                              double* out) const noexcept;

  /// Does the same for inputs that are known to be within the contract.
  ///
  /// Requires  `function` is not null; lanes_outside_contract(boxes) is 0, and that of the points.
  [[nodiscard]] LaneMask call_within_contract(regulus_function function, const double* boxes,
                                              const double* points, double* out) const noexcept;

  /// Sets the outputs of some lanes to [−∞, ∞]. The functions of the kernel are recognised by
  /// their addresses. If a function serves several purposes, the outputs of all of them together
  /// are set.
  void forget(regulus_function function, LaneMask lanes, double* out) const noexcept;

 private:
  [[nodiscard]] std::size_t count_outputs(regulus_function function) const noexcept;

  const regulus_kernel* kernel_;
};

}  // namespace regulus::detail
