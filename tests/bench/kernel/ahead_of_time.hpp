// SPDX-License-Identifier: GPL-3.0-or-later
// The subject as the build compiled it: emitted text, compiled by the suite's compiler with -O2.
#pragma once

#include "runtime/kernel/abi.hpp"
#include "runtime/kernel/isa.hpp"

namespace regulus::detail::bench {

/// Returns nullptr if the processor family has no such instruction set.
[[nodiscard]] const regulus_kernel* ahead_of_time(Isa isa) noexcept;

}  // namespace regulus::detail::bench
