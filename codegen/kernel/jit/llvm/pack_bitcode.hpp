// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>

namespace regulus::detail::plugin {

/// Returns pack_operations.hpp compiled for an instruction set, as LLVM's bitcode; nothing for
/// another name.
[[nodiscard]] std::span<const unsigned char> pack_bitcode(std::string_view isa) noexcept;

}  // namespace regulus::detail::plugin
