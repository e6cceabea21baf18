// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/interval/floating_point_scope.hpp"
#include "runtime/kernel/abi.hpp"

namespace regulus::detail {

/// During its life, the floating-point environment is the one that a kernel of the given
/// REGULUS_ROUND_… needs; then it is the caller's again. The rule of FloatingPointScope holds: call
/// a function that cannot be inlined, such as a function of a kernel.
class RoundingScope {
 public:
  explicit RoundingScope(unsigned rounding) noexcept
      : scope_(rounding == REGULUS_ROUND_UPWARD ? FloatingPointRounding::kUpward
                                                : FloatingPointRounding::kNearest) {}

 private:
  FloatingPointScope scope_;
};

}  // namespace regulus::detail
