// SPDX-License-Identifier: Apache-2.0
// A function of a pack program, laid out for one instruction set.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/machine/pack_program.hpp"
#include "runtime/machine/step.hpp"

namespace regulus::detail::machine {

/// The steps of a function, and the slots of its values in a frame: constants first, then variables
/// and entries of K, then kept values, then the values of the part that runs. A value of the part
/// can take a slot again as soon as the last reader of the old value has run.
///
/// Requires  find_fault finds none.
class MachineFunction {
 public:
  MachineFunction() = default;
  MachineFunction(const PackFunction& function, const StepTable& table);

  /// Runs the function as regulus_function says, in the rounding that the instruction set needs.
  [[nodiscard]] unsigned run(const double* boxes, const double* points, double* out) const noexcept;

  [[nodiscard]] std::size_t slots() const noexcept { return slots_; }
  [[nodiscard]] std::size_t steps() const noexcept { return steps_.size(); }

 private:
  std::vector<Step> steps_;
  std::vector<Slot> constants_;
  std::size_t slots_ = 0;
};

}  // namespace regulus::detail::machine
