// SPDX-License-Identifier: GPL-3.0-or-later
#include "left_product.hpp"
#include "tests/bench/kernel/plain_arithmetic.hpp"

namespace regulus::detail::bench {
namespace {
struct Flags;
}

void plain_scalar(const double* v, const double* k, double* out) noexcept {
  PlainArithmetic<Flags> arithmetic;
  left_product(arithmetic, v, k, out);
}

}  // namespace regulus::detail::bench
