// SPDX-License-Identifier: Apache-2.0
// The compiler options and the rounding of kernels for an instruction set.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "runtime/interval/isa.hpp"

namespace regulus {

/// Ensures   the words of the option --isa: "avx512", "avx2", "portable".
[[nodiscard]] std::string_view name(Isa isa) noexcept;

/// The inverse of name; nullopt for any other word.
[[nodiscard]] std::optional<Isa> parse_isa(std::string_view word) noexcept;

/// Returns the compiler options of a kernel for `isa`, including the macro for
/// runtime/kernel/pack.hpp. They are added to regulus/floating_point_flags.hpp.
[[nodiscard]] std::span<const char* const> compile_flags(Isa isa) noexcept;

/// Returns the REGULUS_ROUND_… that kernels for `isa` need.
[[nodiscard]] unsigned required_rounding(Isa isa) noexcept;

}  // namespace regulus
