// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the sources that the build compiles from the subject: left_product.hpp for the rivals,
// kernel_ISA.cpp for our kernels, and search.cpp, the kernel of a whole search.
//
//     bench_write_sources DIRECTORY
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "codegen/kernel/cpp/emit.hpp"
#include "runtime/kernel/isa.hpp"
#include "tests/bench/kernel/straight_line.hpp"
#include "tests/bench/kernel/subject.hpp"

namespace regulus::detail::bench {
namespace {

/// Does not touch a file that already has this text, so that it is not compiled again.
void write(const std::filesystem::path& path, const std::string& text) {
  std::ostringstream old;
  old << std::ifstream(path).rdbuf();
  if (old.str() == text) return;
  std::ofstream file(path);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

void write_sources(const std::filesystem::path& directory) {
  const Module module = kernel_subject();
  write(directory / "left_product.hpp",
        straight_line_text(left_product_of(module), "left_product"));
  EmitOptions search;
  search.prefix = "bench_search";
  write(directory / "search.cpp", emit(search_subject().module, search).source);
  for (const Isa isa : kAllIsas) {
    EmitOptions options;
    options.prefix = "bench_" + std::string(name(isa));
    write(directory / ("kernel_" + std::string(name(isa)) + ".cpp"), emit(module, options).source);
  }
}

}  // namespace
}  // namespace regulus::detail::bench

int main(int argc, char** argv) {
  if (argc != 2) return 64;
  try {
    regulus::detail::bench::write_sources(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 70;
  }
}
