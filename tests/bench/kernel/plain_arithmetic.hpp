// SPDX-License-Identifier: GPL-3.0-or-later
// Doubles that enclose nothing. For translation units with flags of their own: nothing in here is a
// function that another one might be given.
#pragma once

#include "tests/bench/kernel/operator_arithmetic.hpp"

namespace regulus::bench {

/// `Flags` names the translation unit.
template <class Flags>
struct PlainArithmetic : OperatorArithmetic<double, Flags> {
  [[nodiscard]] static double constant(double lo, double hi) { return lo + (hi - lo) / 2; }
};

// One file each; CMakeLists.txt has their flags.
void plain_scalar(const double* v, const double* k, double* out) noexcept;
void plain_vectorised(const double* v, const double* k, double* out) noexcept;

}  // namespace regulus::bench
