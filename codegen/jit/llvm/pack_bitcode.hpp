// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

namespace regulus::inline jit::plugin {

/// operations/pack_operations.hpp compiled for one instruction set.
struct PackBitcode {
  const char* isa;
  const unsigned char* data;
  std::size_t size;
};

/// Written by write_pack_bitcode.cpp when the project is built.
[[nodiscard]] std::span<const PackBitcode> pack_bitcode() noexcept;

}  // namespace regulus::jit::plugin
