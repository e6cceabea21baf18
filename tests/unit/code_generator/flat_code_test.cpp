// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/llvm/flat_code.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/elf_builder.hpp"

namespace regulus::detail {
namespace {

using plugin::flat_code;
using test::ElfBuilder;
using testing::HasSubstr;

/// A part that is nothing but its function; the tests spoil it.
struct Sound : ElfBuilder {
  std::uint16_t text = code(std::string(16, '\x90'));
  std::uint32_t start = symbol("start", text, 0, 16);
};

std::string refusal_of_bytes(const std::string& bytes, std::uint64_t alignment = 64) {
  try {
    (void)flat_code(bytes, "start", alignment);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "flat";
}
std::string refusal_of(const ElfBuilder& object) { return refusal_of_bytes(object.build()); }

TEST(FlatCode, IsTheCodeThenTheConstantsAndTheDistancesBetweenThem) {
  ElfBuilder object;
  const std::string constants = "0123456789abcdef";
  const auto data = object.section(".rodata", SHF_ALLOC, constants);
  // movsd xmm0, [rip + constant]; ret; int3; jmp start
  const auto code = object.code(std::string("\xF2\x0F\x10\x05\0\0\0\0\xC3\xCC\xE9\0\0\0\0", 15));
  const auto start = object.symbol("start", code, 0, 15, STT_FUNC);
  object.relocate(code, 4, R_X86_64_PC32, object.symbol("", data, 0, 0, STT_SECTION, STB_LOCAL),
                  8 - 4);
  object.relocate(code, 11, R_X86_64_PLT32, start, -4);
  const std::string flat = flat_code(object.build(), "start", 64);
  ASSERT_EQ(flat.size(), 128U);
  EXPECT_EQ(flat.substr(0, 15),
            std::string("\xF2\x0F\x10\x05\x40\0\0\0\xC3\xCC\xE9\xF1\xFF\xFF\xFF", 15));
  EXPECT_EQ(flat.substr(64, 16), constants);
  EXPECT_EQ(flat_code(Sound().build(), "start", 64).size(), 64U);
}

TEST(FlatCode, RefusesWhateverNeedsAnAddressOfTheProcess) {
  Sound absolute, external, slot, variable, zero, thread_local_data;
  absolute.relocate(absolute.text, 0, R_X86_64_64, absolute.start);
  external.relocate(external.text, 0, R_X86_64_PLT32, external.symbol("memcpy", SHN_UNDEF), -4);
  slot.relocate(slot.text, 0, R_X86_64_GOTPCREL, slot.start, -4);
  variable.section(".data", SHF_ALLOC | SHF_WRITE, "x");
  zero.section(".bss", SHF_ALLOC, {}, SHT_NOBITS, 64);
  thread_local_data.section(".tdata", SHF_ALLOC | SHF_TLS, "x");
  for (const ElfBuilder* object :
       {&absolute, &external, &slot, &variable, &zero, &thread_local_data})
    EXPECT_THAT(refusal_of(*object), HasSubstr("more than itself"));
}

TEST(FlatCode, RefusesALargerAlignmentAndAFunctionThatIsNotFirst) {
  Sound aligned;
  aligned.section(".rodata", SHF_ALLOC, "x", SHT_PROGBITS, 0, 128);
  EXPECT_THAT(refusal_of(aligned), HasSubstr("too large an alignment"));
  ElfBuilder late;
  late.symbol("start", late.code(std::string(16, '\x90')), 8, 8);
  EXPECT_THAT(refusal_of(late), HasSubstr("does not begin with its function"));
  EXPECT_THAT(refusal_of(ElfBuilder()), HasSubstr("does not begin with its function"));
}

TEST(FlatCode, RefusesDistancesOutsideTheirSectionOrRange) {
  for (const std::uint64_t offset : {std::uint64_t{13}, std::uint64_t{16}, ~std::uint64_t{0}}) {
    Sound object;
    object.relocate(object.text, offset, R_X86_64_PC32, object.start);
    EXPECT_THAT(refusal_of(object), HasSubstr("outside its section")) << offset;
  }
  for (const std::int64_t addend : {std::int64_t{1} << 31, -(std::int64_t{1} << 32), INT64_MIN}) {
    Sound object;
    object.relocate(object.text, 0, R_X86_64_PC32, object.start, addend);
    EXPECT_THAT(refusal_of(object), HasSubstr("out of range")) << addend;
  }
}

TEST(FlatCode, RefusesWhatIsNoObject) {
  EXPECT_NE(refusal_of_bytes(""), "flat");
  EXPECT_NE(refusal_of_bytes(std::string(64, 'x')), "flat");
  const std::string bytes = Sound().build();
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_NE(refusal_of_bytes(bytes.substr(0, size)), "flat") << size;
}

}  // namespace
}  // namespace regulus::detail
