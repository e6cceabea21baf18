// SPDX-License-Identifier: Apache-2.0
// The instruction sets that code for eight lanes is compiled for, and which of them this processor
// has.
#pragma once

#include <array>

namespace regulus {

enum class Isa { kAvx512, kAvx2, kPortable };

/// Fastest first.
inline constexpr std::array<Isa, 3> kAllIsas = {Isa::kAvx512, Isa::kAvx2, Isa::kPortable};

/// Whether this processor and its operating system can run code for `isa`.
[[nodiscard]] bool supported(Isa isa) noexcept;

/// The fastest one supported. The processor is asked each time, by a few loads and tests: there is
/// no state to initialise or to share.
[[nodiscard]] Isa best_isa() noexcept;

}  // namespace regulus
