// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/jit/loader/object_layout.hpp"

#include <elf.h>

#include <algorithm>
#include <string>

namespace regulus::inline jit {
namespace {

constexpr std::uint64_t kMaximumSize = std::uint64_t{1} << 28;

std::uint64_t round_up(std::uint64_t value, std::uint64_t alignment) noexcept {
  return (value + alignment - 1) & ~(alignment - 1);
}

bool runs_by_itself(const ElfSection& section) noexcept {
  return section.type == SHT_INIT_ARRAY || section.type == SHT_FINI_ARRAY ||
         section.type == SHT_PREINIT_ARRAY || section.name.starts_with(".ctors") ||
         section.name.starts_with(".dtors") || section.name.starts_with(".init") ||
         section.name.starts_with(".fini");
}

Segment segment_of(const ElfSection& section) {
  const auto refuse = [&section](const char* what) {
    throw LoadError("object: section '" + std::string(section.name) + "' " + what);
  };
  const bool writable = (section.flags & SHF_WRITE) != 0;
  const bool executable = (section.flags & SHF_EXECINSTR) != 0;
  if (runs_by_itself(section)) refuse("would have to run when loaded");
  if (section.flags & (SHF_TLS | SHF_COMPRESSED)) refuse("is thread-local or compressed");
  if (section.type != SHT_PROGBITS && section.type != SHT_NOBITS && section.type != SHT_NOTE &&
      section.type != SHT_X86_64_UNWIND)
    refuse("is of an unknown type");
  if (writable && executable) refuse("is writable and executable");
  if (executable) return kCode;
  // .data.rel.ro is writable only for the linker, which fills in addresses.
  return writable && !section.name.starts_with(".data.rel.ro") ? kVariables : kConstants;
}

/// Marks the symbols that need a slot or a stub for the relocations of loaded sections.
void count_indirections(const ElfObject& object, ObjectLayout& layout) {
  for (const ElfSection& section : object.sections)
    for (const ElfRelocation& r : section.relocations) {
      const bool external = object.symbols[r.symbol].section == SHN_UNDEF;
      const bool call = r.type == R_X86_64_PLT32 && external;
      const bool load = r.type == R_X86_64_GOTPCREL || r.type == R_X86_64_GOTPCRELX ||
                        r.type == R_X86_64_REX_GOTPCRELX;
      if (call) layout.stubs[r.symbol] = 0;
      if (call || load) layout.slots[r.symbol] = 0;
    }
}

std::uint64_t place_each(std::vector<std::optional<std::uint64_t>>& items, std::uint64_t cursor,
                         std::uint64_t size) {
  cursor = round_up(cursor, size);
  for (auto& item : items)
    if (item) cursor = (item = cursor).value() + size;
  return cursor;
}

std::uint64_t place_sections(const ElfObject& object, const std::vector<Segment>& segments,
                             Segment segment, std::uint64_t cursor, ObjectLayout& layout) {
  for (std::size_t i = 0; i < object.sections.size(); ++i) {
    const ElfSection& section = object.sections[i];
    if (!section.is_loaded() || segments[i] != segment) continue;
    layout.sections[i] = cursor = round_up(cursor, section.alignment);
    cursor += section.size;
    if (cursor > kMaximumSize) throw LoadError("object: too large");
  }
  return cursor;
}

}  // namespace

ObjectLayout lay_out(const ElfObject& object, std::uint64_t page_size) {
  ObjectLayout layout;
  layout.sections.resize(object.sections.size());
  layout.slots.resize(object.symbols.size());
  layout.stubs.resize(object.symbols.size());
  count_indirections(object, layout);

  std::vector<Segment> segments(object.sections.size(), kSegments);
  for (std::size_t i = 0; i < segments.size(); ++i)
    if (object.sections[i].is_loaded()) segments[i] = segment_of(object.sections[i]);

  std::uint64_t cursor = 0;
  for (const Segment segment : {kCode, kConstants, kVariables}) {
    layout.begin[segment] = cursor;
    cursor = place_sections(object, segments, segment, cursor, layout);
    if (segment == kCode) cursor = place_each(layout.stubs, cursor, ObjectLayout::kStubSize);
    if (segment == kConstants) cursor = place_each(layout.slots, cursor, ObjectLayout::kSlotSize);
    cursor = round_up(cursor, page_size);
  }
  if (cursor > kMaximumSize) throw LoadError("object: too large");
  layout.begin[kSegments] = cursor;
  return layout;
}

}  // namespace regulus::jit
