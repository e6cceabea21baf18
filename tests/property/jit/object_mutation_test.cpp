// SPDX-License-Identifier: GPL-3.0-or-later
// Loading an object with any bytes gives an object or a LoadError. With
// -DREGULUS_SANITIZE=address,undefined this also checks every access. Loaded objects are not run.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "codegen/jit/clang_compiler.hpp"
#include "codegen/jit/kernel_compilation.hpp"
#include "codegen/jit/loader/object_loader.hpp"
#include "tests/support/elf_builder.hpp"
#include "tests/support/random_kernel_text.hpp"

namespace regulus {
namespace {

std::string sound_object() {
  test::ElfBuilder object;
  const auto code = object.code(std::string(64, '\x90'));
  const auto constants = object.section(".rodata", SHF_ALLOC, std::string(40, '\1'));
  const auto table = object.section(".data.rel.ro", SHF_ALLOC | SHF_WRITE, std::string(32, '\0'));
  const auto zero = object.section(".bss", SHF_ALLOC | SHF_WRITE, {}, SHT_NOBITS, 100);
  const auto start = object.symbol("start", code, 0, 32, STT_FUNC);
  const auto local = object.symbol("", constants, 0, 0, STT_SECTION, STB_LOCAL);
  const auto external = object.symbol("memcpy", SHN_UNDEF);
  object.symbol("zero", zero, 0, 100, STT_OBJECT);
  object.symbol("table", table, 0, 32, STT_OBJECT);
  object.relocate(code, 4, R_X86_64_PC32, local, 4);
  object.relocate(code, 12, R_X86_64_PLT32, external, -4);
  object.relocate(code, 20, R_X86_64_REX_GOTPCRELX, external, -4);
  object.relocate(code, 28, R_X86_64_PLT32, start, -4);
  object.relocate(table, 8, R_X86_64_64, start, 16);
  return object.build();
}

struct Tally {
  int loaded = 0;
  int refused = 0;
};

void load(const std::string& bytes, Tally& tally) {
  static const std::vector<ExternalSymbol> externals = kernel_externals();
  // An exact copy on the heap, so that the address sanitizer detects reads beyond the end.
  const std::vector<char> copy(bytes.begin(), bytes.end());
  try {
    (void)load_object(std::as_bytes(std::span(copy)), externals);
    ++tally.loaded;
  } catch (const LoadError&) {
    ++tally.refused;
  }
}

/// Returns a value for which sizes, offsets and indices may go wrong.
std::uint64_t extreme(std::mt19937_64& random) {
  static constexpr std::uint64_t kValues[] = {0,
                                              1,
                                              0x7f,
                                              0xff,
                                              0xffff,
                                              0xfff1,
                                              0x7fffffff,
                                              0x80000000,
                                              0xffffffff,
                                              0x7fffffffffffffff,
                                              0x8000000000000000,
                                              0xffffffffffffffff,
                                              0xfffffffffffffff8};
  return kValues[random() % std::size(kValues)] + random() % 3 - 1;
}

TEST(ObjectMutation, EverySingleByteMayTakeEveryExtremeValue) {
  const std::string sound = sound_object();
  Tally tally;
  for (std::size_t i = 0; i < sound.size(); ++i)
    for (const char value : {'\0', '\1', '\2', '\x7f', '\x80', '\xff'}) {
      std::string bytes = sound;
      bytes[i] = value;
      load(bytes, tally);
    }
  EXPECT_GT(tally.loaded, 1000);
  EXPECT_GT(tally.refused, 1000);
}

TEST(ObjectMutation, FieldsMayTakeExtremeValuesTogether) {
  const std::string sound = sound_object();
  std::mt19937_64 random(20071);
  Tally tally;
  for (int round = 0; round < 20000; ++round) {
    std::string bytes = sound;
    for (std::uint64_t changes = 1 + random() % 3; changes > 0; --changes) {
      const std::size_t width = std::size_t{1} << random() % 4;
      const std::size_t place = random() % (bytes.size() / width) * width;
      const std::uint64_t value = extreme(random);
      std::memcpy(bytes.data() + place, &value, width);
    }
    if (random() % 8 == 0) bytes.resize(random() % bytes.size());
    load(bytes, tally);
  }
  EXPECT_GT(tally.loaded, 1000);
  EXPECT_GT(tally.refused, 1000);
}

TEST(ObjectMutation, AnyByteOfACompiledObjectMayChange) {
  const std::string text = test::RandomKernelText(20, 3).text();
  const Compilation compilation = kernel_compilation(text, Isa::kAvx512);
  const std::string sound = ClangCompiler().compile(compilation).object;
  ASSERT_NE(sound, "");
  std::mt19937_64 random(9);
  Tally tally;
  for (int round = 0; round < 3000; ++round) {
    std::string bytes = sound;
    // Half of the changes are in the tables, although these are a small part of the file.
    const std::size_t range =
        random() % 2 ? bytes.size() : std::min<std::size_t>(bytes.size(), 4096);
    for (std::uint64_t changes = 1 + random() % 4; changes > 0; --changes)
      bytes[bytes.size() - 1 - random() % range] = static_cast<char>(random());
    load(bytes, tally);
  }
  EXPECT_GT(tally.loaded, 100);
  EXPECT_GT(tally.refused, 100);
}

TEST(ObjectMutation, NoiseIsRefused) {
  std::mt19937_64 random(5);
  Tally tally;
  for (int round = 0; round < 2000; ++round) {
    std::string bytes(random() % 512, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    load(bytes, tally);
  }
  EXPECT_EQ(tally.loaded, 0);
}

}  // namespace
}  // namespace regulus
