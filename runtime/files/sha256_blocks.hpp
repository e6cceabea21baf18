// SPDX-License-Identifier: Apache-2.0
// The compression of SHA-256 (FIPS 180-4, §6.2.2), with and without instructions of the processor.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace regulus::detail::sha256_blocks {

inline constexpr std::size_t kBlockBytes = 64;

/// The initial state is in sha256.hpp: fractional parts of the square roots of the first 8 primes
/// (§5.3.3).
using State = std::array<std::uint32_t, 8>;

/// Shape     blocks: whole blocks.
void compress_portably(State& hash, std::string_view blocks);

[[nodiscard]] bool has_instructions();

/// Requires  has_instructions().
void compress_by_instructions(State& hash, std::string_view blocks);

}  // namespace regulus::detail::sha256_blocks
