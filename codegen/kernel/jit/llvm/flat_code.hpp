// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <llvm/ADT/StringRef.h>

#include <cstdint>
#include <string>

namespace regulus::detail::plugin {

/// Returns the code of an object, followed by its constants, valid at every address that is a
/// multiple of `alignment`. So it is loaded by a copy, without LLVM.
///
/// Requires  a relocatable ELF object for x86-64.
/// Ensures   the function `entry` is at the first byte.
/// Throws    std::runtime_error for an object with anything else than code, constants and distances
///           between them, and for a larger alignment.
[[nodiscard]] std::string flat_code(llvm::StringRef object, llvm::StringRef entry,
                                    std::uint64_t alignment);

}  // namespace regulus::detail::plugin
