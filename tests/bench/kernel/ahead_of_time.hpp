// SPDX-License-Identifier: GPL-3.0-or-later
// The subject as the build compiled it: emitted text, the suite's own compiler, -O2.
#pragma once

#include "runtime/kernel/abi.hpp"
#include "runtime/kernel/isa.hpp"

namespace regulus::bench {

/// Null where the processor family has no such instruction set.
[[nodiscard]] const regulus_kernel* ahead_of_time(Isa isa) noexcept;

}  // namespace regulus::bench
