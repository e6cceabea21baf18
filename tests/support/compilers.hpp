// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/spawned_compiler.hpp"

namespace regulus::detail::test {

/// Returns those of g++ and the newest Clang that are installed.
inline std::vector<std::string> installed_compilers() {
  std::vector<std::string> found;
  if (is_installed("g++")) found.push_back("g++");
  for (const char* clang : {"clang++-22", "clang++"})
    if (is_installed(clang)) {
      found.push_back(clang);
      break;
    }
  return found;
}

/// Returns true if the compiler accepts the text without a warning. Makes no code.
inline bool compiles_without_warnings(const std::string& compiler, const std::string& text, Isa isa,
                                      const std::filesystem::path& directory) {
  const auto source = directory / "text.cpp";
  std::ofstream(source) << text;
  std::vector<std::string> command{
      compiler,  "-std=c++20", "-fsyntax-only",         "-Wall",
      "-Wextra", "-Werror",    "-I" REGULUS_SOURCE_DIR, "-I" REGULUS_BINARY_DIR "/include"};
  command.insert(command.end(), std::begin(kFloatingPointFlags), std::end(kFloatingPointFlags));
  const auto flags = compile_flags(isa);
  command.insert(command.end(), flags.begin(), flags.end());
  command.push_back(source.string());
  return run(command) == 0;
}

}  // namespace regulus::detail::test
