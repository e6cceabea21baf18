// SPDX-License-Identifier: Apache-2.0
// The rounding self-test of runtime/kernel/self_test.hpp as a pack program, for engines that make
// kernels from lists.
#pragma once

#include <optional>
#include <string>

#include "runtime/kernel/abi.hpp"
#include "runtime/kernel/isa.hpp"
#include "runtime/machine/pack_program.hpp"

namespace regulus::detail::machine {

/// Ensures   find_fault reports nothing about its functions.
[[nodiscard]] PackKernel self_test_kernel();

/// Runs a kernel made of self_test_kernel() and compares every lane with the known results.
///
/// Requires  `kernel` was made of self_test_kernel() for `isa`, and supported(isa).
/// Ensures   as regulus::check_self_test.
[[nodiscard]] std::optional<std::string> check_self_test(const regulus_kernel& kernel, Isa isa);

}  // namespace regulus::detail::machine
