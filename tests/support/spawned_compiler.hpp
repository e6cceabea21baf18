// SPDX-License-Identifier: GPL-3.0-or-later
// The other way from a text to code, for comparison only: an installed compiler in a process of its
// own, a shared library, and the system's loader.
#pragma once

#include <dlfcn.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "codegen/support/subprocess.hpp"
#include "regulus/floating_point_flags.hpp"
#include "runtime/kernel/isa.hpp"

namespace regulus::detail::test {

class SpawnedLibrary {
 public:
  SpawnedLibrary(void* library, double seconds) : library_(library), seconds_(seconds) {}
  SpawnedLibrary(SpawnedLibrary&& other) noexcept
      : library_(std::exchange(other.library_, nullptr)), seconds_(other.seconds_) {}
  SpawnedLibrary& operator=(SpawnedLibrary&&) = delete;
  ~SpawnedLibrary() {
    if (library_) ::dlclose(library_);
  }

  [[nodiscard]] void* symbol(const char* name) const noexcept { return ::dlsym(library_, name); }
  [[nodiscard]] double seconds() const noexcept { return seconds_; }

 private:
  void* library_;
  double seconds_;
};

/// Runs a command found in PATH; returns its exit status, or −1 if there is no such command.
inline int run(const std::vector<std::string>& command) {
  try {
    return Subprocess(command).wait();
  } catch (const std::system_error&) {
    return -1;
  }
}

inline bool is_installed(const std::string& compiler) {
  return run({"sh", "-c", "command -v " + compiler + " > /dev/null"}) == 0;
}

/// Compiles the text for `isa` with the flags of ahead-of-time code.
///
/// Requires  REGULUS_BINARY_DIR, with the include tree and the interval library.
inline SpawnedLibrary compile_with_spawned(const std::string& compiler, const std::string& text,
                                           Isa isa, const std::filesystem::path& directory,
                                           const char* optimisation = "-O2") {
  const auto source = directory / "kernel.cpp";
  const auto library = directory / ("kernel-" + compiler + "-" + std::string(name(isa)) + ".so");
  std::ofstream(source) << text;
  std::vector<std::string> command{compiler,
                                   "-std=c++20",
                                   "-shared",
                                   "-fPIC",
                                   "-w",
                                   optimisation,
                                   "-I" REGULUS_SOURCE_DIR,
                                   "-I" REGULUS_BINARY_DIR "/include"};
  command.insert(command.end(), std::begin(kFloatingPointFlags), std::end(kFloatingPointFlags));
  const auto flags = compile_flags(isa);
  command.insert(command.end(), flags.begin(), flags.end());
  command.insert(command.end(), {"-o", library.string(), source.string(),
                                 REGULUS_BINARY_DIR "/runtime/interval/libregulus_interval.a"});

  const auto start = std::chrono::steady_clock::now();
  if (run(command) != 0) throw std::runtime_error(compiler + " failed");
  void* loaded = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!loaded) throw std::runtime_error(::dlerror());
  return {loaded, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

}  // namespace regulus::detail::test
