// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "codegen/kernel/program/interpreter.hpp"
#include "codegen/kernel/program/program.hpp"
#include "runtime/interval/interval.hpp"

namespace regulus::detail {

/// Beyond this exponent a result counts as possibly not finite.
inline constexpr long kLargestSafeExponent = 1000;

struct Magnitudes {
  std::vector<long> exponents;    ///< per node: computed bounds are ≤ 2^e in magnitude
  std::vector<bool> needs_check;  ///< per node: its bounds may be infinite until checked
};

/// Bounds the magnitude of every node of a kernel function, for all operands that the ABI allows.
///
/// The packs select the bounds of a product with min and max, which on x86 drop a NaN: 0·∞ would
/// vanish and the product could lose values. So every operand must be finite, and a node whose
/// bound is not below 2^1000 has to be checked: the check marks its lane as undefined if it
/// overflowed. Induction over the nodes: |inputs| ≤ 2^64 and |points| ≤ 2^128 by the ABI; results
/// of guarded operations (division, roots, tan, exp …) are ≤ 2^128 or their lane is undefined; sums
/// add one to the larger exponent, products add exponents. Rounding outward cannot pass the bound:
/// 2^e is itself a double, and e ≥ 0 keeps underflow away. A checked node is finite, at most
/// 2^1024, so the bound of any result from it exceeds 2^1000 again, and the result is checked as
/// well.
[[nodiscard]] Magnitudes bound_magnitudes(const Program& program,
                                          const KnownValues<Interval>& known);

}  // namespace regulus::detail
