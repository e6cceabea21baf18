// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "runtime/kernel/abi.hpp"

namespace regulus::detail {

/// Owns the data of a kernel's functions: compiled code, or programs to interpret.
class LoadedKernel {
 public:
  LoadedKernel() = default;
  LoadedKernel(const LoadedKernel&) = delete;
  LoadedKernel& operator=(const LoadedKernel&) = delete;
  virtual ~LoadedKernel() = default;
  [[nodiscard]] virtual const regulus_kernel& functions() const noexcept = 0;
};

}  // namespace regulus::detail
