// SPDX-License-Identifier: GPL-3.0-or-later
// The operations of packs on real numbers, by MPFR, and on sets if the extremes of the operation
// are easy to find.
#pragma once

#include <optional>

#include "runtime/interval/type.hpp"
#include "tests/property/kernel/pack_operations.hpp"
#include "tests/support/mpfr_bounds.hpp"

namespace regulus::detail::test {

/// One real number from each argument of an operation.
struct Point {
  double x, y, z, p, q;
};

/// The arguments of an operation in one lane.
struct Arguments {
  Interval x, y, z;
  double p, q;
};

class PackOracle {
 public:
  /// Returns the tightest bounds of the operation at a point; nullopt if it is undefined there.
  [[nodiscard]] std::optional<Tightest> at(PackOperation operation, const Point& point);

  /// Returns the tightest bounds of the operation on the sets; nullopt if it is undefined
  /// somewhere. For arithmetic and partial operations: each has its extremes at those of its
  /// arguments, or at x = 0.
  [[nodiscard]] std::optional<Tightest> on(PackOperation operation, const Arguments& arguments);

 private:
  [[nodiscard]] Tightest arithmetic(PackOperation operation, const Point& point);
  [[nodiscard]] Tightest elementary(PackOperation operation, const Point& point);

  MpfrNumber x_, y_, z_, result_;
};

}  // namespace regulus::detail::test
