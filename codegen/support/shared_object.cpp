// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/support/shared_object.hpp"

#include <elf.h>

#include <bit>
#include <cstring>

namespace regulus::detail {
namespace {

#if defined(__x86_64__)
constexpr Elf64_Half kMachine = EM_X86_64;
#elif defined(__aarch64__)
constexpr Elf64_Half kMachine = EM_AARCH64;
#else
#error "this processor's number in an ELF header"
#endif

constexpr unsigned char kByteOrder =
    std::endian::native == std::endian::little ? ELFDATA2LSB : ELFDATA2MSB;

template <class Header>
std::optional<Header> header_at(std::string_view bytes, std::uint64_t offset) {
  if (offset > bytes.size() || bytes.size() - offset < sizeof(Header)) return std::nullopt;
  Header header;
  std::memcpy(&header, bytes.data() + offset, sizeof header);
  return header;
}

bool is_in_file(const Elf64_Phdr& segment, std::string_view bytes) {
  return segment.p_offset <= bytes.size() && segment.p_filesz <= bytes.size() - segment.p_offset;
}

}  // namespace

std::optional<std::string> find_fault_in_shared_object(std::string_view bytes) {
  constexpr const char* kNoElf = "it is not a shared object";
  constexpr const char* kCut = "it is incomplete";
  if (!bytes.starts_with(std::string_view(ELFMAG, SELFMAG))) return kNoElf;
  const auto header = header_at<Elf64_Ehdr>(bytes, 0);
  if (!header) return kCut;
  if (header->e_ident[EI_CLASS] != ELFCLASS64 || header->e_ident[EI_DATA] != kByteOrder ||
      header->e_machine != kMachine)
    return "it is for another processor";
  if (header->e_type != ET_DYN || header->e_phentsize != sizeof(Elf64_Phdr)) return kNoElf;
  bool loads = false;
  for (std::uint64_t i = 0; i < header->e_phnum; ++i) {
    if (header->e_phoff > bytes.size()) return kCut;
    const auto segment = header_at<Elf64_Phdr>(bytes, header->e_phoff + i * sizeof(Elf64_Phdr));
    if (!segment || (segment->p_type != PT_NULL && !is_in_file(*segment, bytes))) return kCut;
    loads = loads || segment->p_type == PT_LOAD;
  }
  if (!loads) return kNoElf;
  return std::nullopt;
}

}  // namespace regulus::detail
