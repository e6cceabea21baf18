// SPDX-License-Identifier: Apache-2.0
// Runs a kernel that is data; this needs no compiler.
#pragma once

#include <memory>

#include "runtime/kernel/abi.hpp"
#include "runtime/kernel/isa.hpp"
#include "runtime/machine/pack_program.hpp"

namespace regulus::detail::machine {

/// A pack program as a kernel. Each of its instructions is one call of the operation's code for an
/// instruction set.
///
/// Requires  the instruction set is supported by this processor.
/// Ensures   the contract of runtime/kernel/abi.hpp; bounds and undefined lanes equal to the bit to
///           those of the program's C++ text compiled for the same instruction set. Calls share
///           nothing that they change. They use only the memory of their stack, unless a function
///           has more than kMaxStackSlots values; if that memory is exhausted, no lane is defined.
/// Throws    std::invalid_argument for a program with a fault that find_fault reports.
/// Rounding  as required_rounding(isa) says.
class MachineKernel {
 public:
  MachineKernel(const PackKernel& program, Isa isa);
  MachineKernel(MachineKernel&&) noexcept;
  MachineKernel& operator=(MachineKernel&&) noexcept;
  ~MachineKernel();

  /// Valid for the life of this object, or of the object to which it was moved.
  [[nodiscard]] const regulus_kernel* get() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace regulus::detail::machine
