// SPDX-License-Identifier: GPL-3.0-or-later
// What the fuzzers of binary formats start from: write_corpus FOLDER.
#include <cstring>
#include <fstream>
#include <string>

#include "codegen/jit/cache/cache_entry.hpp"
#include "tests/support/elf_builder.hpp"

namespace {

std::string object() {
  regulus::test::ElfBuilder object;
  const auto code = object.code(std::string(64, '\x90'));
  const auto table = object.section(".data.rel.ro", SHF_ALLOC | SHF_WRITE, std::string(32, '\0'));
  const auto start = object.symbol("start", code, 0, 32, STT_FUNC);
  const auto external = object.symbol("memcpy", SHN_UNDEF);
  object.symbol("table", table, 0, 32, STT_OBJECT);
  object.relocate(code, 12, R_X86_64_PLT32, external, -4);
  object.relocate(code, 20, R_X86_64_REX_GOTPCRELX, external, -4);
  object.relocate(table, 8, R_X86_64_64, start, 16);
  return object.build();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 64;
  const std::string folder = argv[1];
  const std::string bytes = object();
  const auto header = regulus::make_cache_entry_header(std::string(64, 'a'), bytes);
  std::ofstream(folder + "/object/sound", std::ios::binary) << bytes;
  std::ofstream(folder + "/cache_entry/sound", std::ios::binary)
      << std::string(reinterpret_cast<const char*>(&header), sizeof header) << bytes;
}
