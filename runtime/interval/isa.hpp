// SPDX-License-Identifier: Apache-2.0
// The instruction sets for which code for eight lanes is compiled, and a test which of them this
// processor has.
#pragma once

#include <array>

namespace regulus {

enum class Isa { kAvx512, kAvx2, kPortable };

/// The fastest is first.
inline constexpr std::array<Isa, 3> kAllIsas = {Isa::kAvx512, Isa::kAvx2, Isa::kPortable};

/// Returns true if this processor and its operating system can run code for `isa`.
[[nodiscard]] bool supported(Isa isa) noexcept;

/// Returns the fastest supported one. It asks the processor each time, by a few loads and tests: so
/// there is no state to initialise or to share.
[[nodiscard]] Isa best_isa() noexcept;

}  // namespace regulus
