// SPDX-License-Identifier: GPL-3.0-or-later
// The layout of an object in memory.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "codegen/jit/loader/elf_object.hpp"

namespace regulus::inline jit {

enum Segment : unsigned { kCode, kConstants, kVariables, kSegments };

/// Offsets from the start of one mapping, so that 32 bits suffice for every distance.
///
/// Code         executable sections, then a stub for each external function. The function may be
///              too far for a call, so the stub jumps through its slot.
/// Constants    read-only sections, then a slot for each address that code reads from memory.
/// Variables    the rest.
struct ObjectLayout {
  static constexpr std::uint64_t kStubSize = 8;
  static constexpr std::uint64_t kSlotSize = 8;

  std::vector<std::optional<std::uint64_t>> sections;  ///< empty: not loaded
  std::vector<std::optional<std::uint64_t>> slots;     ///< per symbol
  std::vector<std::optional<std::uint64_t>> stubs;     ///< per symbol; a stub implies a slot
  std::array<std::uint64_t, kSegments + 1> begin{};    ///< of each segment, then the size of all

  [[nodiscard]] std::uint64_t size() const noexcept { return begin[kSegments]; }
};

/// Ensures   segments start at pages, do not overlap and are at most 2^28 bytes together.
/// Throws    LoadError for a section that cannot be loaded.
[[nodiscard]] ObjectLayout lay_out(const ElfObject& object, std::uint64_t page_size);

}  // namespace regulus::jit
