// SPDX-License-Identifier: Apache-2.0
#pragma once

#if defined(__x86_64__)
#include <xmmintrin.h>
#else
#include <cfenv>
#endif

#include "regulus/kernel/abi.hpp"

namespace regulus {

/// While it lives, the floating-point environment is what a kernel needs: its rounding, exceptions
/// masked, no flush to zero, no denormals-are-zero. Then the caller's is put back.
///
/// It does nothing when the environment already fits, which is the usual case: writing MXCSR costs
/// as much as several vector instructions.
class RoundingScope {
 public:
  explicit RoundingScope(unsigned rounding) noexcept;
  ~RoundingScope();
  RoundingScope(const RoundingScope&) = delete;
  RoundingScope& operator=(const RoundingScope&) = delete;

 private:
#if defined(__x86_64__)
  static constexpr unsigned kAllMaskedNearest = 0x1f80;
  static constexpr unsigned kUpwardBits = 0x4000;
  static constexpr unsigned kStickyFlags = 0x3f;

  unsigned wanted_;
  unsigned saved_;
#else
  std::fenv_t saved_;
#endif
};

#if defined(__x86_64__)

inline RoundingScope::RoundingScope(unsigned rounding) noexcept
    : wanted_(kAllMaskedNearest | (rounding == REGULUS_ROUND_UPWARD ? kUpwardBits : 0)),
      saved_(_mm_getcsr()) {
  if ((saved_ & ~kStickyFlags) != wanted_) _mm_setcsr(wanted_);
}
inline RoundingScope::~RoundingScope() {
  if ((saved_ & ~kStickyFlags) != wanted_) _mm_setcsr(saved_);
}

#else

inline RoundingScope::RoundingScope(unsigned rounding) noexcept {
  std::fegetenv(&saved_);
  std::fesetenv(FE_DFL_ENV);
  std::fesetround(rounding == REGULUS_ROUND_UPWARD ? FE_UPWARD : FE_TONEAREST);
}
inline RoundingScope::~RoundingScope() { std::fesetenv(&saved_); }

#endif

}  // namespace regulus
