// SPDX-License-Identifier: GPL-3.0-or-later
// Relocatable object → machine code in this process.
//
// LLVM's own linkers (ORC, JITLink) would do this, too, but only with LLVM in the process: 73 MB
// and 10–20 ms to load it, against 0.1 ms for what is done here. A fresh object and one from the
// cache take the same road, so that what is tested cold is what runs warm.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "codegen/jit/loader/elf_object.hpp"
#include "codegen/jit/loader/memory_mapping.hpp"

namespace regulus::inline jit {

/// A function of this process that an object may call.
struct ExternalSymbol {
  std::string_view name;
  const void* address = nullptr;
};

/// An object in memory: code readable and executable, constants read-only, variables writable, and
/// nothing ever writable and executable at once. Unmapped by the destructor.
class LoadedObject {
 public:
  /// The address of a global symbol with at least `size` bytes behind it; null if there is none.
  [[nodiscard]] void* find(std::string_view name, std::size_t size = 1) const noexcept;

  [[nodiscard]] std::size_t mapped_size() const noexcept { return mapping_.size(); }

 private:
  friend LoadedObject load_object(std::span<const std::byte>, std::span<const ExternalSymbol>);

  struct Symbol {
    std::byte* address;
    std::size_t size;
  };
  using Symbols = std::map<std::string, Symbol, std::less<>>;

  LoadedObject(MemoryMapping mapping, Symbols symbols) noexcept
      : mapping_(std::move(mapping)), symbols_(std::move(symbols)) {}

  MemoryMapping mapping_;
  Symbols symbols_;
};

/// Maps an object and resolves its relocations.
///
/// Requires  `externals` alone is what undefined symbols may resolve to.
/// Ensures   no byte outside the new mapping is written, whatever the bytes are.
/// Throws    LoadError for bytes that are no such object; for a section, symbol or relocation of a
///           kind that is not supported, constructors among them; for an undefined symbol that
///           `externals` does not have. std::bad_alloc.
[[nodiscard]] LoadedObject load_object(std::span<const std::byte> object,
                                       std::span<const ExternalSymbol> externals);

/// The code and constants of an object one after the other, good at every address that is a
/// multiple of `alignment`.
///
/// Ensures   the function `entry` is at the first byte.
/// Throws    LoadError for bytes that are no such object: for whatever needs an address of the
///           process, for variables, and for an alignment that is larger.
[[nodiscard]] std::string flat_code(std::span<const std::byte> object, std::string_view entry,
                                    std::size_t alignment);

}  // namespace regulus::inline jit
