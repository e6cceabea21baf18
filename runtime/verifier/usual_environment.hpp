// SPDX-License-Identifier: Apache-2.0
// The floating-point environment that the bounds of the verifier need.
#pragma once

#include <cfenv>
#include <stdexcept>

namespace regulus::verifier {

/// Sets the usual environment, without exceptions that stop the process, for its own lifetime.
class UsualEnvironment {
 public:
  UsualEnvironment() noexcept { std::feholdexcept(&before_), std::fesetenv(FE_DFL_ENV); }
  UsualEnvironment(const UsualEnvironment&) = delete;
  UsualEnvironment& operator=(const UsualEnvironment&) = delete;
  ~UsualEnvironment() { std::fesetenv(&before_); }

 private:
  std::fenv_t before_;
};

/// Throws unless rounding is to nearest and numbers below 2^-1022 are kept: bounds need both.
inline void require_usual_arithmetic() {
  volatile double least = 0x1p-1074, normal = 0x1p-1022;
  const bool keeps = least * 1.0 > 0.0, reaches = normal * 0.5 > 0.0;
  if (std::fegetround() != FE_TONEAREST)
    throw std::runtime_error("the processor does not round to nearest");
  if (!keeps || !reaches) throw std::runtime_error("the processor flushes small numbers to zero");
}

}  // namespace regulus::verifier
