// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/llvm/flat_code.hpp"

#include <llvm/BinaryFormat/ELF.h>
#include <llvm/BinaryFormat/Magic.h>
#include <llvm/Object/ELFObjectFile.h>
#include <llvm/Support/Endian.h>
#include <llvm/Support/MathExtras.h>

#include <map>
#include <stdexcept>
#include <utility>

namespace regulus::detail::plugin {
namespace {

using llvm::object::ELFSectionRef;
using llvm::object::ELFSymbolRef;
using llvm::object::SectionRef;

template <class T>
T value_of(llvm::Expected<T> expected) {
  if (!expected) throw std::runtime_error(llvm::toString(expected.takeError()));
  return std::move(*expected);
}

[[noreturn]] void refuse(const char* what) {
  throw std::runtime_error(std::string("object: a part ") + what);
}

/// Places sections one after the other and writes the distances between them.
class Flattener {
 public:
  Flattener(const llvm::object::ELF64LEObjectFile& object, std::uint64_t alignment)
      : object_(object), alignment_(alignment) {}

  std::string flatten() {
    place_all([](const ELFSectionRef& s) { return s.isText(); });
    place_all([](const ELFSectionRef& s) { return !s.isText(); });
    code_.resize(llvm::alignTo(code_.size(), alignment_));
    for (const ELFSectionRef table : object_.sections()) relocate_by(table);
    return std::move(code_);
  }

  [[nodiscard]] std::uint64_t offset_of(const ELFSymbolRef& symbol) const {
    const auto section = value_of(symbol.getSection());
    const auto found =
        section == object_.section_end() ? begin_.end() : begin_.find(section->getIndex());
    if (found == begin_.end()) refuse("that needs more than itself");
    return found->second + value_of(symbol.getValue());
  }

 private:
  template <class Choice>
  void place_all(Choice chosen) {
    code_.resize(llvm::alignTo(code_.size(), alignment_));
    for (const ELFSectionRef section : object_.sections())
      if ((section.getFlags() & llvm::ELF::SHF_ALLOC) != 0 && chosen(section)) place(section);
  }

  void place(const ELFSectionRef& section) {
    if ((section.getFlags() & ~kAllowed) != 0 || section.isBSS() ||
        section.getType() != llvm::ELF::SHT_PROGBITS)
      refuse("that needs more than itself");
    const std::uint64_t own = section.getAlignment().value();
    if (own > alignment_) refuse("of too large an alignment");
    code_.resize(llvm::alignTo(code_.size(), own));
    begin_[section.getIndex()] = code_.size();
    code_ += value_of(section.getContents());
  }

  void relocate_by(const SectionRef& table) {
    const auto target = value_of(table.getRelocatedSection());
    const auto placed =
        target == object_.section_end() ? begin_.end() : begin_.find(target->getIndex());
    if (placed == begin_.end()) return;
    for (const llvm::object::ELFRelocationRef r : table.relocations()) {
      if (r.getType() != llvm::ELF::R_X86_64_PC32 && r.getType() != llvm::ELF::R_X86_64_PLT32)
        refuse("that needs more than itself");
      if (r.getOffset() > target->getSize() || kWidth > target->getSize() - r.getOffset())
        refuse("with a distance outside its section");
      write_distance(placed->second + r.getOffset(), r);
    }
  }

  void write_distance(std::uint64_t at, const llvm::object::ELFRelocationRef& r) {
    if (r.getSymbol() == object_.symbol_end()) refuse("that needs more than itself");
    const auto addend = static_cast<std::uint64_t>(value_of(r.getAddend()));
    const auto distance = static_cast<std::int64_t>(offset_of(*r.getSymbol()) + addend - at);
    if (!llvm::isInt<32>(distance)) refuse("with a distance out of range");
    llvm::support::endian::write32le(&code_[at], static_cast<std::uint32_t>(distance));
  }

  static constexpr std::uint64_t kWidth = 4;
  static constexpr std::uint64_t kAllowed = llvm::ELF::SHF_ALLOC | llvm::ELF::SHF_EXECINSTR |
                                            llvm::ELF::SHF_MERGE | llvm::ELF::SHF_STRINGS;

  const llvm::object::ELF64LEObjectFile& object_;
  std::uint64_t alignment_;
  std::map<std::uint64_t, std::uint64_t> begin_;  ///< of each section that was placed, by its index
  std::string code_;
};

}  // namespace

std::string flat_code(llvm::StringRef object, llvm::StringRef entry, std::uint64_t alignment) {
  if (llvm::identify_magic(object) != llvm::file_magic::elf_relocatable)
    refuse("that is no object");
  const auto file = value_of(llvm::object::ELF64LEObjectFile::create({object, "part"}));
  Flattener flattener(file, alignment);
  std::string code = flattener.flatten();
  for (const ELFSymbolRef symbol : file.symbols())
    if (value_of(symbol.getName()) == entry && flattener.offset_of(symbol) == 0) return code;
  refuse("that does not begin with its function");
}

}  // namespace regulus::detail::plugin
