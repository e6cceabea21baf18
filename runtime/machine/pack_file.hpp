// SPDX-License-Identifier: Apache-2.0
// A pack program as bytes, for a cache or for a process that has no compiler.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "runtime/machine/pack_program.hpp"

namespace regulus::machine {

/// Ensures   equal programs give equal bytes, and others do not.
[[nodiscard]] std::string to_bytes(const PackKernel& program);

/// The program; nullopt unless the bytes are those of one that find_fault has no objection to.
[[nodiscard]] std::optional<PackKernel> read_pack_kernel(std::string_view bytes);

}  // namespace regulus::machine
