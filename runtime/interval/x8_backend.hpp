// SPDX-License-Identifier: Apache-2.0
// The eight-lane functions, compiled once per instruction set. x8.hpp calls one; tests call each.
#pragma once

#include "runtime/interval/isa.hpp"

namespace regulus::detail {

/// Each requires MXCSR at nearest; everything else is as in runtime/interval/x8.hpp.
struct X8Backend {
  using Function = unsigned (*)(const double* in, double* out) noexcept;
  Function sin, cos, sincos, tan, asin, acos, atan, atan2, exp, log;
};

/// Requires  supported(isa) before a function of it is called.
[[nodiscard]] const X8Backend& x8_backend(Isa isa) noexcept;

extern const X8Backend kX8Portable;
#if defined(__x86_64__)
extern const X8Backend kX8Avx2;
extern const X8Backend kX8Avx512;
#endif

}  // namespace regulus::detail
