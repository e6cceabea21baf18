// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/jit/loader/object_loader.hpp"

#include <elf.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

#include "codegen/jit/loader/object_layout.hpp"

namespace regulus::inline jit {
namespace {

/// Fills a mapping with one object. Addresses are computed modulo 2^64, as the ELF rules do: an
/// addend from untrusted bytes may wrap, and the result is checked to fit its field.
class Linker {
 public:
  Linker(const ElfObject& object, const ObjectLayout& layout, std::byte* memory,
         std::span<const ExternalSymbol> externals) noexcept
      : object_(object), layout_(layout), memory_(memory), externals_(externals) {}

  void link() const {
    copy_sections();
    fill_slots_and_stubs();
    for (std::size_t i = 0; i < object_.sections.size(); ++i)
      for (const ElfRelocation& r : object_.sections[i].relocations) apply(r, i);
  }

  [[nodiscard]] std::byte* address_of(const ElfSymbol& symbol) const {
    const auto refuse = [&symbol](const char* what) {
      throw LoadError("object: symbol '" + std::string(symbol.name) + "' " + what);
    };
    if (symbol.type == STT_TLS || symbol.type == STT_GNU_IFUNC) refuse("is of an unsupported kind");
    if (symbol.section == SHN_UNDEF || symbol.section >= object_.sections.size() ||
        !layout_.sections[symbol.section])
      refuse("is not in a loaded section");
    const std::uint64_t size = object_.sections[symbol.section].size;
    if (symbol.value > size || symbol.size > size - symbol.value)
      refuse("reaches past its section");
    return memory_ + *layout_.sections[symbol.section] + symbol.value;
  }

 private:
  void copy_sections() const {
    for (std::size_t i = 0; i < object_.sections.size(); ++i) {
      const auto contents = object_.sections[i].contents;
      if (layout_.sections[i] && !contents.empty())
        std::memcpy(memory_ + *layout_.sections[i], contents.data(), contents.size());
    }
  }

  /// Stub: jmp *slot(%rip), which is FF 25 and the distance from the end of the instruction.
  void fill_slots_and_stubs() const {
    constexpr std::uint64_t kJumpSize = 6;
    for (std::size_t i = 0; i < object_.symbols.size(); ++i) {
      if (!layout_.slots[i]) continue;
      const std::uint64_t slot = *layout_.slots[i];
      write(slot, value_of(object_.symbols[i]));
      if (!layout_.stubs[i]) continue;
      const std::uint64_t stub = *layout_.stubs[i];
      write(stub, std::uint16_t{0x25FF});
      write(stub + 2, static_cast<std::uint32_t>(slot - (stub + kJumpSize)));
    }
  }

  /// S of the ELF rules: the address, here or elsewhere in the process.
  [[nodiscard]] std::uint64_t value_of(const ElfSymbol& symbol) const {
    if (symbol.section != SHN_UNDEF) return reinterpret_cast<std::uintptr_t>(address_of(symbol));
    const auto found = std::ranges::find(externals_, symbol.name, &ExternalSymbol::name);
    if (found == externals_.end() || symbol.name.empty())
      throw LoadError("object: symbol '" + std::string(symbol.name) + "' is not defined");
    return reinterpret_cast<std::uintptr_t>(found->address);
  }

  void apply(const ElfRelocation& r, std::size_t section) const {
    const bool wide = r.type == R_X86_64_64;
    const std::uint64_t offset = place(r, section, wide ? 8 : 4);
    const std::uint64_t here = address(offset);
    const auto addend = static_cast<std::uint64_t>(r.addend);
    const ElfSymbol& symbol = object_.symbols[r.symbol];
    switch (r.type) {
      case R_X86_64_64:
        return write(offset, value_of(symbol) + addend);
      case R_X86_64_PC32:
        return write_signed(offset, value_of(symbol) + addend - here);
      case R_X86_64_PLT32: {
        const auto stub = layout_.stubs[r.symbol];
        return write_signed(offset, (stub ? address(*stub) : value_of(symbol)) + addend - here);
      }
      case R_X86_64_GOTPCREL:
      case R_X86_64_GOTPCRELX:
      case R_X86_64_REX_GOTPCRELX:
        return write_signed(offset, address(layout_.slots[r.symbol].value()) + addend - here);
      default:
        throw LoadError("object: relocation of unsupported type " + std::to_string(r.type));
    }
  }

  /// The offset in memory of the `width` bytes to patch.
  [[nodiscard]] std::uint64_t place(const ElfRelocation& r, std::size_t section,
                                    std::uint64_t width) const {
    const std::uint64_t size = object_.sections[section].contents.size();
    if (r.offset > size || width > size - r.offset)
      throw LoadError("object: a relocation outside its section");
    return layout_.sections[section].value() + r.offset;
  }

  [[nodiscard]] std::uint64_t address(std::uint64_t offset) const noexcept {
    return reinterpret_cast<std::uintptr_t>(memory_) + offset;
  }

  template <class T>
  void write(std::uint64_t offset, T value) const noexcept {
    std::memcpy(memory_ + offset, &value, sizeof(T));
  }

  void write_signed(std::uint64_t offset, std::uint64_t value) const {
    const auto signed_value = static_cast<std::int64_t>(value);
    if (signed_value < std::numeric_limits<std::int32_t>::min() ||
        signed_value > std::numeric_limits<std::int32_t>::max())
      throw LoadError("object: a relocation out of range");
    write(offset, static_cast<std::int32_t>(signed_value));
  }

  const ElfObject& object_;
  const ObjectLayout& layout_;
  std::byte* memory_;
  std::span<const ExternalSymbol> externals_;
};

/// True if the object does not depend on its address.
bool is_free_of_addresses(const ElfObject& object) {
  for (const ElfSection& section : object.sections)
    for (const ElfRelocation& r : section.relocations)
      if ((r.type != R_X86_64_PC32 && r.type != R_X86_64_PLT32) ||
          object.symbols[r.symbol].section == SHN_UNDEF)
        return false;
  return true;
}

bool is_exported(const ElfSymbol& symbol) noexcept {
  return symbol.section != SHN_UNDEF && !symbol.name.empty() &&
         (symbol.binding == STB_GLOBAL || symbol.binding == STB_WEAK);
}

void seal(const MemoryMapping& mapping, const ObjectLayout& layout) {
  const auto seal_segment = [&](Segment s, MemoryMapping::Access access) {
    if (!mapping.seal(layout.begin[s], layout.begin[s + 1] - layout.begin[s], access))
      throw LoadError("the system refuses executable memory");
  };
  seal_segment(kCode, MemoryMapping::Access::kExecutable);
  seal_segment(kConstants, MemoryMapping::Access::kReadOnly);
}

}  // namespace

LoadedObject load_object(std::span<const std::byte> bytes,
                         std::span<const ExternalSymbol> externals) {
  const ElfObject object = read_elf_object(bytes);
  const ObjectLayout layout = lay_out(object, MemoryMapping::page_size());
  if (layout.size() == 0) throw LoadError("object: nothing to load");

  MemoryMapping mapping(layout.size());
  const Linker linker(object, layout, mapping.data(), externals);
  linker.link();
  LoadedObject::Symbols symbols;
  for (const ElfSymbol& symbol : object.symbols)
    if (is_exported(symbol))
      symbols.try_emplace(
          std::string(symbol.name),
          LoadedObject::Symbol{linker.address_of(symbol), static_cast<std::size_t>(symbol.size)});
  seal(mapping, layout);
  return LoadedObject(std::move(mapping), std::move(symbols));
}

std::string flat_code(std::span<const std::byte> bytes, std::string_view entry,
                      std::size_t alignment) {
  const ElfObject object = read_elf_object(bytes);
  const ObjectLayout layout = lay_out(object, alignment);
  if (!is_free_of_addresses(object) || layout.begin[kVariables] != layout.size())
    throw LoadError("object: a part that needs more than itself");
  for (const ElfSection& section : object.sections)
    if (section.is_loaded() && section.alignment > alignment)
      throw LoadError("object: a part of too large an alignment");
  std::string code(layout.size(), '\0');
  auto* memory = reinterpret_cast<std::byte*>(code.data());
  const Linker linker(object, layout, memory, {});
  linker.link();
  const auto found = std::ranges::find(object.symbols, entry, &ElfSymbol::name);
  if (found == object.symbols.end() || linker.address_of(*found) != memory)
    throw LoadError("object: a part that does not begin with its function");
  return code;
}

void* LoadedObject::find(std::string_view name, std::size_t size) const noexcept {
  const auto found = symbols_.find(name);
  return found != symbols_.end() && found->second.size >= size ? found->second.address : nullptr;
}

}  // namespace regulus::jit
