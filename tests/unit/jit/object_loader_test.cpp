// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/jit/loader/object_loader.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "tests/support/elf_builder.hpp"
#include "tests/support/process_maps.hpp"

namespace regulus {
namespace {

using test::ElfBuilder;

LoadedObject load(const ElfBuilder& object, std::span<const ExternalSymbol> externals = {}) {
  const std::string bytes = object.build();
  return load_object(std::as_bytes(std::span(bytes)), externals);
}

std::string bytes_of(double value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

template <class Function>
Function function(const LoadedObject& object, const char* name) {
  return reinterpret_cast<Function>(object.find(name));
}

std::string operator""_bytes(const char* text, std::size_t size) { return {text, size}; }

const std::string kReturn = "\xC3";
const std::string kAddressFromSlot = "\x48\x8B\x05\0\0\0\0"_bytes;  // mov  rax, [rip + …]

int answer() { return 42; }

TEST(ObjectLoader, ReachesConstantsRelativeToTheCode) {
  ElfBuilder object;
  // movsd xmm0, [rip + constant]; ret
  const auto code = object.code("\xF2\x0F\x10\x05\0\0\0\0\xC3"_bytes);
  const auto data = object.section(".rodata", SHF_ALLOC, bytes_of(1.25) + bytes_of(-2.5));
  const auto constants = object.symbol("", data, 0, 0, STT_SECTION, STB_LOCAL);
  object.symbol("constant", code, 0, 9, STT_FUNC);
  object.relocate(code, 4, R_X86_64_PC32, constants, 8 - 4);
  const LoadedObject loaded = load(object);
  EXPECT_EQ(function<double (*)()>(loaded, "constant")(), -2.5);
}

TEST(ObjectLoader, CallsAnotherFunctionOfTheObject) {
  ElfBuilder object;
  // jmp second; int3; second: mov eax, 7; ret
  const auto code = object.code("\xE9\0\0\0\0\xCC\xB8\x07\0\0\0\xC3"_bytes);
  object.symbol("first", code, 0, 5, STT_FUNC);
  const auto second = object.symbol("second", code, 6, 6, STT_FUNC);
  object.relocate(code, 1, R_X86_64_PLT32, second, -4);
  const LoadedObject loaded = load(object);
  EXPECT_EQ(function<int (*)()>(loaded, "first")(), 7);
}

TEST(ObjectLoader, CallsAFunctionOfTheProcessHoweverFarAway) {
  ElfBuilder object;
  const auto code = object.code("\xE9\0\0\0\0"_bytes);  // jmp external
  object.symbol("call", code, 0, 5, STT_FUNC);
  object.relocate(code, 1, R_X86_64_PLT32, object.symbol("answer", SHN_UNDEF), -4);
  const ExternalSymbol externals[] = {{"other", nullptr},
                                      {"answer", reinterpret_cast<const void*>(&answer)}};
  const LoadedObject loaded = load(object, externals);
  EXPECT_EQ(function<int (*)()>(loaded, "call")(), 42);
}

TEST(ObjectLoader, FillsSlotsWithTheAddressesOfBothKindsOfSymbol) {
  for (const std::uint32_t type : {R_X86_64_GOTPCREL, R_X86_64_GOTPCRELX, R_X86_64_REX_GOTPCRELX}) {
    ElfBuilder object;
    const auto code = object.code(kAddressFromSlot + kReturn + kAddressFromSlot + kReturn);
    const auto variable = object.symbol(
        "variable", object.section(".data", SHF_ALLOC | SHF_WRITE, bytes_of(3)), 0, 8);
    object.symbol("inside", code, 0, 8, STT_FUNC);
    object.symbol("outside", code, 8, 8, STT_FUNC);
    object.relocate(code, 3, type, variable, -4);
    object.relocate(code, 11, type, object.symbol("answer", SHN_UNDEF), -4);
    const ExternalSymbol externals[] = {{"answer", reinterpret_cast<const void*>(&answer)}};
    const LoadedObject loaded = load(object, externals);
    EXPECT_EQ(function<void* (*)()>(loaded, "inside")(), loaded.find("variable"));
    EXPECT_EQ(function<void* (*)()>(loaded, "outside")(), reinterpret_cast<void*>(&answer));
  }
}

TEST(ObjectLoader, FillsTablesWithAbsoluteAddresses) {
  ElfBuilder object;
  const auto code = object.code("\xCC\xB8\x09\0\0\0\xC3"_bytes);  // int3; mov eax, 9; ret
  const auto table = object.section(".data.rel.ro", SHF_ALLOC | SHF_WRITE, std::string(16, '\0'));
  object.symbol("table", table, 0, 16, STT_OBJECT);
  object.relocate(table, 8, R_X86_64_64, object.symbol("", code, 0, 0, STT_SECTION, STB_LOCAL), 1);
  const LoadedObject loaded = load(object);
  auto* entries = static_cast<int (*const*)()>(loaded.find("table", 16));
  ASSERT_NE(entries, nullptr);
  EXPECT_EQ(entries[0], nullptr);
  EXPECT_EQ(entries[1](), 9);
}

TEST(ObjectLoader, GivesEverySegmentItsOwnRights) {
  ElfBuilder object;
  object.symbol("code", object.code(kReturn));
  object.symbol("constant", object.section(".rodata", SHF_ALLOC, "constant"));
  object.symbol("table", object.section(".data.rel.ro.local", SHF_ALLOC | SHF_WRITE, "table"));
  object.symbol("variable", object.section(".data", SHF_ALLOC | SHF_WRITE, "variable"));
  object.symbol("zero", object.section(".bss", SHF_ALLOC | SHF_WRITE, {}, SHT_NOBITS, 64));
  const LoadedObject loaded = load(object);
  const auto rights = [&](const char* name) {
    return test::range_of(loaded.find(name, 0)).value().rights;
  };
  EXPECT_EQ(rights("code"), "r-xp");
  EXPECT_EQ(rights("constant"), "r--p");
  EXPECT_EQ(rights("table"), "r--p");
  EXPECT_EQ(rights("variable"), "rw-p");
  EXPECT_EQ(rights("zero"), "rw-p");
}

TEST(ObjectLoader, KeepsAlignmentsAndClearsWhatHasNoContents) {
  ElfBuilder object;
  object.symbol("odd", object.section(".data", SHF_ALLOC | SHF_WRITE, "x", SHT_PROGBITS, 0, 1));
  object.symbol("zero", object.section(".bss", SHF_ALLOC | SHF_WRITE, {}, SHT_NOBITS, 5000, 64), 0,
                5000);
  const LoadedObject loaded = load(object);
  const auto* zero = static_cast<const char*>(loaded.find("zero", 5000));
  ASSERT_NE(zero, nullptr);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(zero) % 64, 0u);
  EXPECT_EQ(std::string(zero, 5000), std::string(5000, '\0'));
}

TEST(ObjectLoader, FindsOnlyGlobalSymbolsThatAreLargeEnough) {
  ElfBuilder object;
  const auto data = object.section(".rodata", SHF_ALLOC, "0123456789abcdef");
  object.symbol("global", data, 8, 8, STT_OBJECT);
  object.symbol("weak", data, 0, 8, STT_OBJECT, STB_WEAK);
  object.symbol("local", data, 0, 8, STT_OBJECT, STB_LOCAL);
  const LoadedObject loaded = load(object);
  EXPECT_STREQ(static_cast<const char*>(loaded.find("global", 8)), "89abcdef");
  EXPECT_NE(loaded.find("weak"), nullptr);
  EXPECT_EQ(loaded.find("global", 9), nullptr);
  EXPECT_EQ(loaded.find("local"), nullptr);
  EXPECT_EQ(loaded.find("absent"), nullptr);
}

TEST(ObjectLoader, UnmapsWhenDestroyedAndOnlyThen) {
  ElfBuilder object;
  object.symbol("code", object.code(kReturn), 0, 1);
  const void* address = nullptr;
  {
    LoadedObject first = load(object);
    const LoadedObject second = std::move(first);
    address = second.find("code");
    EXPECT_TRUE(test::range_of(address).has_value());
  }
  const auto range = test::range_of(address);
  EXPECT_TRUE(!range || range->rights != "r-xp");
}

}  // namespace
}  // namespace regulus
