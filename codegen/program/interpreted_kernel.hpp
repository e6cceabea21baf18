// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "regulus/codegen/program/module.hpp"
#include "regulus/kernel/abi.hpp"

namespace regulus::codegen {

/// A module as a kernel without compiling it: its functions interpret their programs lane by lane.
/// The engine where there is no compiler, and the oracle of compiled kernels.
///
/// Requires  a module that check_module accepts; std::invalid_argument otherwise.
/// Ensures   the contract of regulus/kernel/abi.hpp. Calls share nothing that they change, so that
///           any number of threads may run them at once. A call that gets no memory reports all
///           lanes as undefined.
/// Rounding  to nearest (REGULUS_ROUND_NEAREST).
class InterpretedKernel {
 public:
  explicit InterpretedKernel(const Module& module);
  InterpretedKernel(InterpretedKernel&&) noexcept;
  InterpretedKernel& operator=(InterpretedKernel&&) noexcept;
  ~InterpretedKernel();

  /// Valid as long as this object or the one it was moved to.
  [[nodiscard]] const regulus_kernel* get() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace regulus::codegen
