// SPDX-License-Identifier: Apache-2.0
// A pack program as bytes, for a cache or for a process that has no compiler.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "runtime/machine/pack_program.hpp"

namespace regulus::detail::machine {

/// Ensures   equal programs give equal bytes; different programs give different bytes.
[[nodiscard]] std::string to_bytes(const PackKernel& program);

/// Returns the program; nullopt unless the bytes are those of a program without a fault.
[[nodiscard]] std::optional<PackKernel> read_pack_kernel(std::string_view bytes);

}  // namespace regulus::detail::machine
