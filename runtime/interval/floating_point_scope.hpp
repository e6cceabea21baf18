// SPDX-License-Identifier: Apache-2.0
// Sets the floating-point environment for a scope, and restores the caller's at its end.
//
// The danger: a compiler does not know the rounding mode. It may move an addition from inside the
// scope to a place before it or after it, because nothing it sees connects the two. The rule: the
// function with the scope does no floating-point work itself. It calls a function that cannot be
// inlined (in another file, through a pointer, or [[gnu::noinline]]) and that reads its operands
// from memory.
#pragma once

#if !defined(__x86_64__)
#include <cfenv>
#endif

namespace regulus::detail {

enum class FloatingPointRounding { kNearest, kUpward };

#if defined(__x86_64__)

[[nodiscard]] inline unsigned read_mxcsr() noexcept {
  unsigned value;
  asm volatile("stmxcsr %0" : "=m"(value) : : "memory");
  return value;
}

inline void write_mxcsr(unsigned value) noexcept {
  asm volatile("ldmxcsr %0" : : "m"(value) : "memory");
}

/// Ensures   during its life: the given rounding, FTZ and DAZ off, every exception masked. Then
///           these are as before. It writes MXCSR only if that changes anything: it is slow.
class FloatingPointScope {
 public:
  explicit FloatingPointScope(FloatingPointRounding rounding) noexcept : saved_(read_mxcsr()) {
    const unsigned wanted =
        kMaskedNearest | (rounding == FloatingPointRounding::kUpward ? kUpwardBits : 0);
    changed_ = (saved_ & ~kStickyFlags) != wanted;
    if (changed_) write_mxcsr(wanted);
  }
  ~FloatingPointScope() {
    if (changed_) write_mxcsr(saved_);
  }
  FloatingPointScope(const FloatingPointScope&) = delete;
  FloatingPointScope& operator=(const FloatingPointScope&) = delete;

 private:
  static constexpr unsigned kMaskedNearest = 0x1f80;
  static constexpr unsigned kUpwardBits = 0x4000;
  static constexpr unsigned kStickyFlags = 0x3f;

  unsigned saved_;
  bool changed_;
};

#else

/// The same, by the C library.
class FloatingPointScope {
 public:
  explicit FloatingPointScope(FloatingPointRounding rounding) noexcept {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
    if (rounding == FloatingPointRounding::kUpward) std::fesetround(FE_UPWARD);
  }
  ~FloatingPointScope() { std::fesetenv(&saved_); }
  FloatingPointScope(const FloatingPointScope&) = delete;
  FloatingPointScope& operator=(const FloatingPointScope&) = delete;

 private:
  std::fenv_t saved_;
};

#endif

}  // namespace regulus::detail
