// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the schema of the JSON reports, and their types for the page and Python:
// write_schema SCHEMA TYPESCRIPT PYTHON.
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "codegen/answer/schema.hpp"

namespace {

bool write(const char* path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  return static_cast<bool>(file.flush());
}

}  // namespace

int main(int argc, char** argv) {
  using namespace regulus;
  using namespace regulus::detail;
  if (argc != 4) {
    std::cerr << "usage: regulus_write_schema SCHEMA TYPESCRIPT PYTHON\n";
    return 64;
  }
  const bool written = write(argv[1], json_schema().dump(1) + '\n') &&
                       write(argv[2], typescript_types()) && write(argv[3], python_types());
  if (!written) std::cerr << "cannot write the files of the schema\n";
  return written ? 0 : 74;
}
