// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "regulus/kernel/abi.hpp"

namespace regulus::codegen {

/// A kernel that begins as one and goes on as another of the same functions, in the middle of a
/// search.
///
/// Sound at every moment: a function of either kernel encloses the same expressions over the box
/// that it is given, on its own; no test asks which kernel gave the bounds that it combines. Each
/// call takes the kernel of that moment as a whole, its context and the rounding it needs included.
class SwitchingKernel {
 public:
  /// Requires  `first` outlives this; so does what it is switched to.
  explicit SwitchingKernel(const regulus_kernel& first);
  SwitchingKernel(const SwitchingKernel&) = delete;
  SwitchingKernel& operator=(const SwitchingKernel&) = delete;
  ~SwitchingKernel();

  /// As of `first`, but for addresses and the rounding: to nearest, whatever comes later.
  [[nodiscard]] const regulus_kernel& functions() const noexcept;

  /// Calls from now on go to `next`. May be called while other threads call functions; once.
  ///
  /// Ensures   false, and nothing has changed, unless `next` has the same sizes, functions, lists
  /// of
  ///           derivatives and nominal values as the first.
  [[nodiscard]] bool switch_to(const regulus_kernel& next) noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace regulus::codegen
