// SPDX-License-Identifier: GPL-3.0-or-later
// Loads a relocatable object as machine code into this process.
//
// LLVM's own linkers (ORC, JITLink) could do this, too, but only with LLVM in the process: 73 MB
// and 10–20 ms to load it, against 0.1 ms here. New objects and cached objects are loaded by the
// same code, so tests without a cache also cover runs with one.
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
  /// Returns the address of a global symbol with at least `size` bytes; null if there is none.
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
/// Requires  `externals` has all functions that undefined symbols may resolve to.
/// Ensures   no byte outside the new mapping is written, whatever the bytes are.
/// Throws    LoadError for bytes that are not such an object; for a section, symbol or relocation
///           of a kind that is not supported, constructors among them; for an undefined symbol that
///           `externals` does not have. std::bad_alloc.
[[nodiscard]] LoadedObject load_object(std::span<const std::byte> object,
                                       std::span<const ExternalSymbol> externals);

/// Returns the code of an object, followed by its constants, valid at every address that is a
/// multiple of `alignment`.
///
/// Ensures   the function `entry` is at the first byte.
/// Throws    LoadError for bytes that are not such an object, for an object that needs an address
///           of the process, for variables, and for a larger alignment.
[[nodiscard]] std::string flat_code(std::span<const std::byte> object, std::string_view entry,
                                    std::size_t alignment);

}  // namespace regulus::jit
