// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/measure/machine.hpp"

#include <cstdlib>
#include <fstream>
#include <thread>

#include "codegen/kernel/jit/clang_compiler.hpp"

namespace regulus::detail::bench {
namespace {

/// Returns the processor's name as the kernel reports it; "unknown" if it reports none.
std::string processor_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) {
      const std::size_t colon = line.find(": ");
      if (colon != std::string::npos) return line.substr(colon + 2);
    }
  return "unknown";
}

}  // namespace

Machine this_machine() {
  Machine machine;
  machine.processor = processor_model();
  machine.processors = std::thread::hardware_concurrency();
  static_cast<void>(getloadavg(&machine.load, 1));
#if defined(__clang__)
  machine.compiler = "clang " __clang_version__;
#else
  machine.compiler = "g++ " __VERSION__;
#endif
  const std::string identity = ClangCompiler().identity();
  machine.in_process = identity.substr(0, identity.find_first_of(";,\n("));
  return machine;
}

}  // namespace regulus::detail::bench
