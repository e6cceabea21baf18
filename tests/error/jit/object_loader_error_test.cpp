// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/jit/loader/object_loader.hpp"
#include "tests/support/elf_builder.hpp"

namespace regulus {
namespace {

using test::ElfBuilder;
using testing::HasSubstr;

std::string refusal_of_bytes(const std::string& bytes) {
  try {
    (void)load_object(std::as_bytes(std::span(bytes)), {});
  } catch (const LoadError& error) {
    return error.what();
  }
  return "loaded";
}
std::string refusal_of(const ElfBuilder& object) { return refusal_of_bytes(object.build()); }

/// A small object that loads; the tests damage it.
struct Sound : ElfBuilder {
  std::uint16_t text = code(std::string(16, '\x90'));
  std::uint32_t start = symbol("start", text, 0, 16);
};

TEST(ObjectLoaderError, TheObjectToBeSpoiltLoads) { EXPECT_EQ(refusal_of(Sound()), "loaded"); }

TEST(ObjectLoaderError, RefusesWhatIsNotElf) {
  EXPECT_THAT(refusal_of_bytes(""), HasSubstr("past the end"));
  EXPECT_THAT(refusal_of_bytes(std::string(64, 'x')), HasSubstr("not ELF"));
}

TEST(ObjectLoaderError, RefusesAnotherMachineAndAnotherKindOfFile) {
  std::string bytes = Sound().build();
  bytes[offsetof(Elf64_Ehdr, e_machine)] = EM_386;
  EXPECT_THAT(refusal_of_bytes(bytes), HasSubstr("not for x86-64"));
  bytes = Sound().build();
  bytes[offsetof(Elf64_Ehdr, e_type)] = ET_DYN;
  EXPECT_THAT(refusal_of_bytes(bytes), HasSubstr("not relocatable"));
}

TEST(ObjectLoaderError, RefusesEveryTruncation) {
  const std::string bytes = Sound().build();
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_NE(refusal_of_bytes(bytes.substr(0, size)), "loaded") << size;
}

TEST(ObjectLoaderError, RefusesAnObjectWithoutAnythingToLoad) {
  EXPECT_THAT(refusal_of(ElfBuilder()), HasSubstr("nothing to load"));
}

TEST(ObjectLoaderError, RefusesSymbolsThatNobodyDefines) {
  Sound object;
  object.relocate(object.text, 0, R_X86_64_PLT32, object.symbol("system", SHN_UNDEF), -4);
  EXPECT_THAT(refusal_of(object), HasSubstr("'system' is not defined"));
}

TEST(ObjectLoaderError, RefusesRelocationsAgainstTheNullSymbol) {
  Sound object;
  object.relocate(object.text, 0, R_X86_64_64, 0);
  EXPECT_THAT(refusal_of(object), HasSubstr("is not defined"));
}

TEST(ObjectLoaderError, RefusesUnknownRelocations) {
  Sound object;
  object.relocate(object.text, 0, R_X86_64_TPOFF32, object.start);
  EXPECT_THAT(refusal_of(object), HasSubstr("unsupported type 23"));
}

TEST(ObjectLoaderError, RefusesRelocationsOutsideTheirSection) {
  for (const std::uint64_t offset : {std::uint64_t{13}, std::uint64_t{16}, ~std::uint64_t{0}}) {
    Sound object;
    object.relocate(object.text, offset, R_X86_64_PC32, object.start);
    EXPECT_THAT(refusal_of(object), HasSubstr("outside its section")) << offset;
  }
  Sound wide;
  wide.relocate(wide.text, 9, R_X86_64_64, wide.start);
  EXPECT_THAT(refusal_of(wide), HasSubstr("outside its section"));
}

TEST(ObjectLoaderError, RefusesRelocationsOfMemoryWithoutContents) {
  Sound object;
  const auto bss = object.section(".bss", SHF_ALLOC | SHF_WRITE, {}, SHT_NOBITS, 64);
  object.relocate(bss, 0, R_X86_64_64, object.start);
  EXPECT_THAT(refusal_of(object), HasSubstr("outside its section"));
}

TEST(ObjectLoaderError, RefusesDistancesThatDoNotFit) {
  for (const std::int64_t addend : {std::int64_t{1} << 31, -(std::int64_t{1} << 32), INT64_MIN}) {
    Sound object;
    object.relocate(object.text, 0, R_X86_64_PC32, object.start, addend);
    EXPECT_THAT(refusal_of(object), HasSubstr("out of range")) << addend;
  }
}

TEST(ObjectLoaderError, RefusesInPartsWhateverNeedsAnAddressOfTheProcess) {
  const auto refusal = [](const ElfBuilder& object, std::size_t alignment = 64) -> std::string {
    const std::string bytes = object.build();
    try {
      (void)flat_code(std::as_bytes(std::span(bytes)), "start", alignment);
    } catch (const LoadError& error) {
      return error.what();
    }
    return "flat";
  };
  EXPECT_EQ(refusal(Sound()), "flat");
  Sound absolute, external, slot, variable, aligned;
  absolute.relocate(absolute.text, 0, R_X86_64_64, absolute.start);
  EXPECT_THAT(refusal(absolute), HasSubstr("more than itself"));
  external.relocate(external.text, 0, R_X86_64_PLT32, external.symbol("memcpy", SHN_UNDEF), -4);
  EXPECT_THAT(refusal(external), HasSubstr("more than itself"));
  slot.relocate(slot.text, 0, R_X86_64_GOTPCREL, slot.start, -4);
  EXPECT_THAT(refusal(slot), HasSubstr("more than itself"));
  variable.section(".data", SHF_ALLOC | SHF_WRITE, "x");
  EXPECT_THAT(refusal(variable), HasSubstr("more than itself"));
  aligned.section(".rodata", SHF_ALLOC, "x", SHT_PROGBITS, 0, 128);
  EXPECT_THAT(refusal(aligned), HasSubstr("too large an alignment"));
  ElfBuilder late;
  late.symbol("start", late.code(std::string(16, '\x90')), 8, 8);
  EXPECT_THAT(refusal(late), HasSubstr("does not begin with its function"));
}

TEST(ObjectLoaderError, RefusesSectionsThatWouldRunWhenLoaded) {
  for (const std::uint32_t type : {SHT_INIT_ARRAY, SHT_FINI_ARRAY, SHT_PREINIT_ARRAY}) {
    Sound object;
    object.section(".array", SHF_ALLOC | SHF_WRITE, std::string(8, '\0'), type);
    EXPECT_THAT(refusal_of(object), HasSubstr("'.array' would have to run")) << type;
  }
  Sound object;
  object.section(".ctors", SHF_ALLOC | SHF_WRITE, std::string(8, '\0'));
  EXPECT_THAT(refusal_of(object), HasSubstr("'.ctors' would have to run"));
}

TEST(ObjectLoaderError, RefusesSectionsOfUnsupportedKinds) {
  Sound writable_code;
  writable_code.section(".both", SHF_ALLOC | SHF_WRITE | SHF_EXECINSTR, "x");
  EXPECT_THAT(refusal_of(writable_code), HasSubstr("'.both' is writable and executable"));
  Sound thread_local_data;
  thread_local_data.section(".tdata", SHF_ALLOC | SHF_WRITE | SHF_TLS, "x");
  EXPECT_THAT(refusal_of(thread_local_data), HasSubstr("'.tdata' is thread-local"));
  Sound unknown;
  unknown.section(".hash", SHF_ALLOC, "x", SHT_HASH);
  EXPECT_THAT(refusal_of(unknown), HasSubstr("'.hash' is of an unknown type"));
}

TEST(ObjectLoaderError, RefusesSizesAndAlignmentsOutOfAllProportion) {
  Sound huge;
  huge.section(".bss", SHF_ALLOC | SHF_WRITE, {}, SHT_NOBITS, std::uint64_t{1} << 40);
  EXPECT_THAT(refusal_of(huge), HasSubstr("too large"));
  Sound many;
  for (int i = 0; i < 3; ++i)
    many.section(".bss", SHF_ALLOC | SHF_WRITE, {}, SHT_NOBITS, std::uint64_t{100} << 20);
  EXPECT_THAT(refusal_of(many), HasSubstr("too large"));
  for (const std::uint64_t alignment : {std::uint64_t{3}, std::uint64_t{8192}}) {
    Sound object;
    object.section(".odd", SHF_ALLOC, "x", SHT_PROGBITS, 0, alignment);
    EXPECT_THAT(refusal_of(object), HasSubstr("alignment")) << alignment;
  }
}

TEST(ObjectLoaderError, RefusesSymbolsThatReachPastTheirSection) {
  Sound object;
  object.symbol("long", object.text, 8, 9);
  EXPECT_THAT(refusal_of(object), HasSubstr("'long' reaches past its section"));
  Sound far;
  far.symbol("far", far.text, ~std::uint64_t{0}, 2);
  EXPECT_THAT(refusal_of(far), HasSubstr("'far' reaches past its section"));
}

TEST(ObjectLoaderError, RefusesSymbolsOutsideLoadedSections) {
  for (const std::uint16_t section : {SHN_ABS, SHN_COMMON, SHN_XINDEX, 200}) {
    Sound object;
    object.symbol("nowhere", section);
    EXPECT_THAT(refusal_of(object), HasSubstr("'nowhere' is not in a loaded section")) << section;
  }
  Sound object;
  object.symbol("note", object.section(".comment", 0, "text"));
  EXPECT_THAT(refusal_of(object), HasSubstr("'note' is not in a loaded section"));
}

TEST(ObjectLoaderError, RefusesThreadLocalAndIndirectSymbols) {
  for (const unsigned type : {STT_TLS, STT_GNU_IFUNC}) {
    Sound object;
    object.symbol("special", object.text, 0, 1, type);
    EXPECT_THAT(refusal_of(object), HasSubstr("'special' is of an unsupported kind")) << type;
  }
}

}  // namespace
}  // namespace regulus
