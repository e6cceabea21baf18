// SPDX-License-Identifier: GPL-3.0-or-later
// Doubles that enclose nothing, for translation units with their own flags. No function in here can
// replace one of another translation unit.
#pragma once

#include "tests/bench/kernel/operator_arithmetic.hpp"

namespace regulus::detail::bench {

/// `Flags` identifies the translation unit.
template <class Flags>
struct PlainArithmetic : OperatorArithmetic<double, Flags> {
  [[nodiscard]] static double constant(double lo, double hi) { return lo + (hi - lo) / 2; }
};

// Each function has a file of its own; CMakeLists.txt has the flags.
void plain_scalar(const double* v, const double* k, double* out) noexcept;
void plain_vectorised(const double* v, const double* k, double* out) noexcept;

}  // namespace regulus::detail::bench
