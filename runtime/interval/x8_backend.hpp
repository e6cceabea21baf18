// SPDX-License-Identifier: Apache-2.0
// The eight-lane functions compiled once per instruction set. What x8.hpp calls; tests call each.
#pragma once

#include <array>

namespace regulus {

/// Each expects MXCSR at nearest and is otherwise as in regulus/interval/x8.hpp.
struct X8Backend {
  using Function = unsigned (*)(const double* in, double* out) noexcept;
  Function sin, cos, sincos, tan, asin, acos, atan, atan2, exp, log;
};

enum class X8Isa { kBaseline, kAvx2, kAvx512 };
inline constexpr std::array kX8Isas{X8Isa::kBaseline, X8Isa::kAvx2, X8Isa::kAvx512};

/// Whether this processor, with this operating system, can run it.
[[nodiscard]] bool x8_available(X8Isa isa) noexcept;

/// Requires  x8_available(isa) before a function of it is called.
[[nodiscard]] const X8Backend& x8_backend(X8Isa isa) noexcept;

extern const X8Backend kX8Baseline;
#if defined(__x86_64__)
extern const X8Backend kX8Avx2;
extern const X8Backend kX8Avx512;
#endif

}  // namespace regulus
