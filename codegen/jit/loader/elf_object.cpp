// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/jit/loader/elf_object.hpp"

#include <elf.h>

#include <bit>
#include <cstring>
#include <string>
#include <type_traits>

namespace regulus::inline jit {
namespace {

constexpr std::uint64_t kMaximumSectionSize = std::uint64_t{1} << 28;
constexpr std::uint64_t kMaximumAlignment = 4096;

/// Every access to the bytes goes through here.
class Bytes {
 public:
  explicit Bytes(std::span<const std::byte> bytes) noexcept : bytes_(bytes) {}

  [[nodiscard]] std::span<const std::byte> slice(std::uint64_t offset, std::uint64_t size) const {
    if (offset > bytes_.size() || size > bytes_.size() - offset)
      throw LoadError("object: a part reaches past the end");
    return bytes_.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(size));
  }

  /// Copies, because nothing in the file need be aligned.
  template <class T>
  [[nodiscard]] T read(std::uint64_t offset) const {
    static_assert(std::is_trivially_copyable_v<T>);
    T value;
    std::memcpy(&value, slice(offset, sizeof(T)).data(), sizeof(T));
    return value;
  }

  template <class T>
  [[nodiscard]] std::vector<T> read_table() const {
    if (bytes_.size() % sizeof(T) != 0) throw LoadError("object: a table of uneven size");
    std::vector<T> table(bytes_.size() / sizeof(T));
    if (!table.empty()) std::memcpy(table.data(), bytes_.data(), bytes_.size());
    return table;
  }

  /// The zero-terminated string that starts at `offset`.
  [[nodiscard]] std::string_view string(std::uint64_t offset) const {
    const auto rest = slice(offset, bytes_.size() - std::min<std::uint64_t>(offset, bytes_.size()));
    const char* first = reinterpret_cast<const char*>(rest.data());
    const void* end = rest.empty() ? nullptr : std::memchr(first, 0, rest.size());
    if (!end) throw LoadError("object: a name without an end");
    return {first, static_cast<std::size_t>(static_cast<const char*>(end) - first)};
  }

 private:
  std::span<const std::byte> bytes_;
};

Elf64_Ehdr read_header(const Bytes& bytes) {
  const auto header = bytes.read<Elf64_Ehdr>(0);
  if (std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) throw LoadError("object: not ELF");
  if (header.e_ident[EI_CLASS] != ELFCLASS64 || header.e_ident[EI_DATA] != ELFDATA2LSB ||
      header.e_machine != EM_X86_64)
    throw LoadError("object: not for x86-64");
  if (header.e_type != ET_REL) throw LoadError("object: not relocatable");
  if (header.e_shentsize != sizeof(Elf64_Shdr) || header.e_shnum == 0)
    throw LoadError("object: no section table");
  return header;
}

std::vector<Elf64_Shdr> read_section_headers(const Bytes& bytes, const Elf64_Ehdr& header) {
  const auto table = bytes.slice(header.e_shoff, header.e_shnum * sizeof(Elf64_Shdr));
  return Bytes(table).read_table<Elf64_Shdr>();
}

/// The bytes of section `index`, which must be of one of the types.
Bytes section_of_type(const Bytes& bytes, const std::vector<Elf64_Shdr>& headers,
                      std::uint64_t index, std::uint32_t type) {
  if (index >= headers.size() || headers[index].sh_type != type)
    throw LoadError("object: a link to the wrong kind of section");
  return Bytes(bytes.slice(headers[index].sh_offset, headers[index].sh_size));
}

ElfSection read_section(const Bytes& bytes, const Elf64_Shdr& header, const Bytes& names) {
  ElfSection section;
  section.name = names.string(header.sh_name);
  section.type = header.sh_type;
  section.flags = header.sh_flags;
  section.size = header.sh_size;
  section.alignment = header.sh_addralign == 0 ? 1 : header.sh_addralign;
  if (header.sh_size > kMaximumSectionSize) throw LoadError("object: a section is too large");
  if (!std::has_single_bit(section.alignment) || section.alignment > kMaximumAlignment)
    throw LoadError("object: an alignment that is no power of two up to 4096");
  if (header.sh_type != SHT_NOBITS && header.sh_type != SHT_NULL)
    section.contents = bytes.slice(header.sh_offset, header.sh_size);
  return section;
}

std::vector<ElfSymbol> read_symbols(const Bytes& bytes, const std::vector<Elf64_Shdr>& headers,
                                    const Elf64_Shdr& table) {
  const Bytes names = section_of_type(bytes, headers, table.sh_link, SHT_STRTAB);
  std::vector<ElfSymbol> symbols;
  for (const Elf64_Sym& s :
       Bytes(bytes.slice(table.sh_offset, table.sh_size)).read_table<Elf64_Sym>())
    symbols.push_back({names.string(s.st_name), s.st_shndx,
                       static_cast<std::uint8_t>(ELF64_ST_TYPE(s.st_info)),
                       static_cast<std::uint8_t>(ELF64_ST_BIND(s.st_info)), s.st_value, s.st_size});
  return symbols;
}

void append_relocations(const Bytes& bytes, const Elf64_Shdr& table, std::size_t symbols,
                        std::vector<ElfRelocation>& relocations) {
  for (const Elf64_Rela& r :
       Bytes(bytes.slice(table.sh_offset, table.sh_size)).read_table<Elf64_Rela>()) {
    const std::uint64_t symbol = ELF64_R_SYM(r.r_info);
    if (symbol >= symbols) throw LoadError("object: a relocation against no symbol");
    relocations.push_back({r.r_offset, static_cast<std::uint32_t>(ELF64_R_TYPE(r.r_info)),
                           static_cast<std::uint32_t>(symbol), r.r_addend});
  }
}

/// The index of the only symbol table.
std::size_t find_symbol_table(const std::vector<Elf64_Shdr>& headers) {
  std::size_t found = 0;
  for (std::size_t i = 1; i < headers.size(); ++i) {
    if (headers[i].sh_type != SHT_SYMTAB) continue;
    if (found != 0) throw LoadError("object: two symbol tables");
    found = i;
  }
  if (found == 0) throw LoadError("object: no symbol table");
  return found;
}

}  // namespace

bool ElfSection::is_loaded() const noexcept { return (flags & SHF_ALLOC) != 0 && type != SHT_NULL; }

ElfObject read_elf_object(std::span<const std::byte> file) {
  const Bytes bytes(file);
  const Elf64_Ehdr header = read_header(bytes);
  const std::vector<Elf64_Shdr> headers = read_section_headers(bytes, header);
  const Bytes names = section_of_type(bytes, headers, header.e_shstrndx, SHT_STRTAB);

  ElfObject object;
  for (const Elf64_Shdr& h : headers) object.sections.push_back(read_section(bytes, h, names));
  const std::size_t symbol_table = find_symbol_table(headers);
  object.symbols = read_symbols(bytes, headers, headers[symbol_table]);

  for (const Elf64_Shdr& h : headers) {
    if (h.sh_type != SHT_RELA && h.sh_type != SHT_REL) continue;
    if (h.sh_info >= headers.size()) throw LoadError("object: relocations of no section");
    ElfSection& target = object.sections[h.sh_info];
    if (!target.is_loaded()) continue;
    if (h.sh_type == SHT_REL) throw LoadError("object: relocations without addends");
    if (h.sh_link != symbol_table) throw LoadError("object: relocations of another symbol table");
    append_relocations(bytes, h, object.symbols.size(), target.relocations);
  }
  return object;
}

}  // namespace regulus::jit
