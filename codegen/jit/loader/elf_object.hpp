// SPDX-License-Identifier: GPL-3.0-or-later
// A relocatable ELF object for x86-64, read from untrusted bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace regulus::inline jit {

/// The bytes are not an object that can be loaded; what() says why.
class LoadError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ElfRelocation {
  std::uint64_t offset = 0;  ///< from the start of the section it patches
  std::uint32_t type = 0;    ///< R_X86_64_…
  std::uint32_t symbol = 0;  ///< index into ElfObject::symbols
  std::int64_t addend = 0;
};

struct ElfSection {
  std::string_view name;
  std::uint32_t type = 0;       ///< SHT_…
  std::uint64_t flags = 0;      ///< SHF_…
  std::uint64_t size = 0;       ///< in memory; contents are empty for SHT_NOBITS
  std::uint64_t alignment = 1;  ///< a power of two
  std::span<const std::byte> contents;
  std::vector<ElfRelocation> relocations;

  [[nodiscard]] bool is_loaded() const noexcept;
};

struct ElfSymbol {
  std::string_view name;
  std::uint16_t section = 0;  ///< an index into ElfObject::sections, or SHN_UNDEF, SHN_ABS, …
  std::uint8_t type = 0;      ///< STT_…
  std::uint8_t binding = 0;   ///< STB_…
  std::uint64_t value = 0;
  std::uint64_t size = 0;
};

/// Names and contents point into the bytes that were read.
struct ElfObject {
  std::vector<ElfSection> sections;
  std::vector<ElfSymbol> symbols;
};

/// Reads headers, symbols and relocations.
///
/// Ensures   every name and every section lies inside `bytes`; every relocation names a symbol of
///           the table; section sizes are at most 2^28 and alignments at most 4096.
///           The loader checks whether a relocation fits its section.
/// Throws    LoadError for anything else, whatever the bytes are.
[[nodiscard]] ElfObject read_elf_object(std::span<const std::byte> bytes);

}  // namespace regulus::jit
