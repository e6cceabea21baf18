// SPDX-License-Identifier: GPL-3.0-or-later
// A separate part of a pack program's function: the unit of compilation and of the cache.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/machine/pack_program.hpp"

namespace regulus::detail {

/// Values are numbers of instructions of the part; constants are in the order of their first use.
struct PartProgram {
  std::vector<machine::PackInstruction> code;
  std::vector<Interval> constants;
};

/// The function that a part is compiled to.
inline constexpr std::string_view kPartSymbol = "part";

/// The code of a part, then its constants, is valid at every address that is a multiple of this.
/// The function begins at the first byte.
inline constexpr std::size_t kCodeAlignment = 64;

/// Returns part number `part` as bytes that have only one reading.
///
/// Requires  find_fault finds none in the function.
/// Ensures   parts with equal bytes compute the same from the same slots. The bytes contain nothing
///           else of the function, and not the place of the part in it.
[[nodiscard]] std::string part_bytes(const machine::PackFunction& function, std::size_t part);

/// Requires  bytes of part_bytes.
[[nodiscard]] PartProgram read_part(std::string_view bytes);

/// Returns the name of a part's machine code in the cache.
///
/// Shape     64 hexadecimal digits.
/// Requires  `compiler` changes with everything else that the machine code depends on.
[[nodiscard]] std::string part_name(std::string_view bytes, std::string_view isa,
                                    std::string_view compiler);

}  // namespace regulus::detail
