// SPDX-License-Identifier: Apache-2.0
// Runs a kernel that is data: no compiler is needed.
#pragma once

#include <memory>

#include "runtime/kernel/abi.hpp"
#include "runtime/kernel/isa.hpp"
#include "runtime/machine/pack_program.hpp"

namespace regulus::machine {

/// A pack program as a kernel: each of its instructions is one call of the operation's code for an
/// instruction set.
///
/// Requires  the instruction set is supported by this processor.
/// Ensures   the contract of runtime/kernel/abi.hpp; bounds and undefined lanes equal to the bit to
///           those of the program's C++ text compiled for the same instruction set. Calls share
///           nothing that they change, and take no memory but their stack's unless a function has
///           more than kMaxStackSlots values; where such memory is exhausted no lane is defined.
/// Throws    std::invalid_argument for a program that find_fault objects to.
/// Rounding  as required_rounding(isa) says.
class MachineKernel {
 public:
  MachineKernel(const PackKernel& program, Isa isa);
  MachineKernel(MachineKernel&&) noexcept;
  MachineKernel& operator=(MachineKernel&&) noexcept;
  ~MachineKernel();

  /// Valid as long as this object or the one it was moved to.
  [[nodiscard]] const regulus_kernel* get() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace regulus::machine
