// SPDX-License-Identifier: Apache-2.0
// The instruction sets kernels are compiled for.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

namespace regulus {

enum class Isa { kAvx512, kAvx2, kPortable };

/// Fastest first.
inline constexpr std::array<Isa, 3> kAllIsas = {Isa::kAvx512, Isa::kAvx2, Isa::kPortable};

/// Ensures   the words of the option --isa: "avx512", "avx2", "portable".
[[nodiscard]] std::string_view name(Isa isa) noexcept;

/// The inverse of name; nullopt for any other word.
[[nodiscard]] std::optional<Isa> parse_isa(std::string_view word) noexcept;

/// Whether this processor and its operating system can run code for `isa`.
[[nodiscard]] bool supported(Isa isa) noexcept;

/// The fastest one supported.
[[nodiscard]] Isa best_isa() noexcept;

/// What a compiler is told to compile a kernel for `isa`, the macro for regulus/kernel/pack.hpp
/// included; to be added to regulus/floating_point_flags.hpp.
[[nodiscard]] std::span<const char* const> compile_flags(Isa isa) noexcept;

/// The REGULUS_ROUND_… that kernels for `isa` need.
[[nodiscard]] unsigned required_rounding(Isa isa) noexcept;

}  // namespace regulus
