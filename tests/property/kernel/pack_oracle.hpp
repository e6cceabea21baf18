// SPDX-License-Identifier: GPL-3.0-or-later
// What the operations of packs are on real numbers, by MPFR, and on sets where the operation is
// simple enough to say what its extremes are.
#pragma once

#include <optional>

#include "runtime/interval/type.hpp"
#include "tests/property/kernel/pack_operations.hpp"
#include "tests/support/mpfr_bounds.hpp"

namespace regulus::test {

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
  /// The tightest bounds of the operation at a point; nullopt where it is undefined.
  [[nodiscard]] std::optional<Tightest> at(PackOperation operation, const Point& point);

  /// The tightest bounds of the operation on the sets, nullopt if undefined somewhere. For
  /// arithmetic and partial operations; each takes its extremes where its arguments do, or where x
  /// = 0.
  [[nodiscard]] std::optional<Tightest> on(PackOperation operation, const Arguments& arguments);

 private:
  [[nodiscard]] Tightest arithmetic(PackOperation operation, const Point& point);
  [[nodiscard]] Tightest elementary(PackOperation operation, const Point& point);

  MpfrNumber x_, y_, z_, result_;
};

}  // namespace regulus::test
