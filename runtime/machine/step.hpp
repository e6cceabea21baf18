// SPDX-License-Identifier: Apache-2.0
// The steps of the vector machine: a pointer to an operation's code, and places of operands.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "runtime/interval/lanes.hpp"
#include "runtime/kernel/isa.hpp"
#include "runtime/machine/pack_program.hpp"

namespace regulus::detail::machine {

/// Memory for one value of eight lanes, an interval or exact doubles, in the form that the packs of
/// one instruction set use. All of them need 128 bytes for an interval.
struct alignas(64) Slot {
  double lanes[2 * kLanes];
};

/// One call of a function: its arguments, its values, and the lanes found undefined so far.
struct Frame {
  const double* boxes;
  const double* points;
  double* out;
  Slot* slots;
  unsigned undefined;
};

struct Step;
using StepFunction = void (*)(Frame& frame, const Step& step);

/// r is the slot of the result; a, b and c are slots, or the numbers of the instruction.
struct Step {
  StepFunction run;
  std::uint32_t r, a, b, c;
};

/// The operations of one instruction set.
struct StepTable {
  std::array<StepFunction, kPackOperations> run;   ///< null: the operation is no step
  StepFunction copy;                               ///< slot b to slot r
  void (*fill)(Slot& slot, double lo, double hi);  ///< the same interval in every lane
  void (*fill_exact)(Slot& slot, double value);    ///< the same double in every lane
};

/// Requires  the instruction set is one that this program was built for.
[[nodiscard]] const StepTable& step_table(Isa isa) noexcept;

}  // namespace regulus::detail::machine
