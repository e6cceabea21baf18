// SPDX-License-Identifier: GPL-3.0-or-later
// Builds relocatable objects: valid ones to load, invalid ones to refuse.
#pragma once

#include <elf.h>

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace regulus::detail::test {

class ElfBuilder {
 public:
  ElfBuilder() {
    sections_.push_back({});
    symbols_.push_back({});
  }

  /// Returns the index of the section. `size` matters only for SHT_NOBITS.
  std::uint16_t section(const std::string& name, std::uint64_t flags, const std::string& contents,
                        std::uint32_t type = SHT_PROGBITS, std::uint64_t size = 0,
                        std::uint64_t alignment = 16) {
    Section s{name, contents, {}, {}};
    s.header.sh_type = type;
    s.header.sh_flags = flags;
    s.header.sh_size = type == SHT_NOBITS ? size : contents.size();
    s.header.sh_addralign = alignment;
    sections_.push_back(s);
    return static_cast<std::uint16_t>(sections_.size() - 1);
  }
  std::uint16_t code(const std::string& bytes) {
    return section(".text", SHF_ALLOC | SHF_EXECINSTR, bytes);
  }

  /// Returns the index of the symbol.
  std::uint32_t symbol(const std::string& name, std::uint16_t section, std::uint64_t value = 0,
                       std::uint64_t size = 0, unsigned type = STT_NOTYPE,
                       unsigned binding = STB_GLOBAL) {
    Elf64_Sym s{};
    s.st_name = add_name(name);
    s.st_info = static_cast<unsigned char>(ELF64_ST_INFO(binding, type));
    s.st_shndx = section;
    s.st_value = value;
    s.st_size = size;
    symbols_.push_back(s);
    return static_cast<std::uint32_t>(symbols_.size() - 1);
  }

  void relocate(std::uint16_t section, std::uint64_t offset, std::uint32_t type,
                std::uint32_t symbol, std::int64_t addend = 0) {
    sections_[section].relocations.push_back(
        {offset, ELF64_R_INFO(std::uint64_t{symbol}, type), addend});
  }

  [[nodiscard]] std::string build() const {
    std::vector<Section> all = sections_;
    const auto symbol_table = static_cast<std::uint32_t>(all.size());
    all.push_back(table(".symtab", SHT_SYMTAB, symbols_, symbol_table + 1, 0));
    all.push_back(table(".strtab", SHT_STRTAB, names_, 0, 0));
    for (std::uint32_t i = 0; i < sections_.size(); ++i)
      if (!sections_[i].relocations.empty())
        all.push_back(table(".rela" + sections_[i].name, SHT_RELA, sections_[i].relocations,
                            symbol_table, i));
    return write(all);
  }

 private:
  struct Section {
    std::string name;
    std::string contents;
    Elf64_Shdr header;
    std::vector<Elf64_Rela> relocations;
  };

  template <class Container>
  static Section table(const std::string& name, std::uint32_t type, const Container& items,
                       std::uint32_t link, std::uint32_t info) {
    const auto bytes = std::as_bytes(std::span(items));
    Section s{name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, {}, {}};
    s.header.sh_type = type;
    s.header.sh_size = bytes.size();
    s.header.sh_entsize = sizeof items[0];
    s.header.sh_link = link;
    s.header.sh_info = info;
    s.header.sh_addralign = 8;
    return s;
  }

  std::uint32_t add_name(const std::string& name) {
    if (name.empty()) return 0;
    const auto offset = static_cast<std::uint32_t>(names_.size());
    names_.append(name).push_back('\0');
    return offset;
  }

  static std::string write(std::vector<Section> all) {
    all.push_back({".shstrtab", {}, {}, {}});
    std::string section_names(1, '\0');
    for (Section& s : all) {
      s.header.sh_name = static_cast<std::uint32_t>(section_names.size());
      section_names.append(s.name).push_back('\0');
    }
    all.back().contents = section_names;
    all.back().header.sh_type = SHT_STRTAB;
    all.back().header.sh_size = section_names.size();

    Elf64_Ehdr header{};
    std::memcpy(header.e_ident, ELFMAG, SELFMAG);
    header.e_ident[EI_CLASS] = ELFCLASS64;
    header.e_ident[EI_DATA] = ELFDATA2LSB;
    header.e_ident[EI_VERSION] = EV_CURRENT;
    header.e_type = ET_REL;
    header.e_machine = EM_X86_64;
    header.e_version = EV_CURRENT;
    header.e_ehsize = sizeof(Elf64_Ehdr);
    header.e_shentsize = sizeof(Elf64_Shdr);
    header.e_shnum = static_cast<std::uint16_t>(all.size());
    header.e_shstrndx = static_cast<std::uint16_t>(all.size() - 1);

    std::string body;
    for (Section& s : all) {
      body.resize((body.size() + 15) & ~std::size_t{15});
      s.header.sh_offset = sizeof header + body.size();
      body += s.contents;
    }
    header.e_shoff = sizeof header + body.size();
    std::string file(reinterpret_cast<const char*>(&header), sizeof header);
    file += body;
    for (const Section& s : all)
      file.append(reinterpret_cast<const char*>(&s.header), sizeof s.header);
    return file;
  }

  std::vector<Section> sections_;
  std::vector<Elf64_Sym> symbols_;
  std::string names_ = std::string(1, '\0');
};

}  // namespace regulus::detail::test
