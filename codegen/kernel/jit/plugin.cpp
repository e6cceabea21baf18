// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/plugin.hpp"

#include <dlfcn.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdlib>
#include <system_error>
#include <vector>

#include "codegen/kernel/jit/clang_interface.h"
#include "codegen/kernel/jit/plugin_folder.h"
#include "codegen/support/executable_folder.hpp"

namespace regulus::detail {
namespace {

namespace fs = std::filesystem;

/// Returns the folders that may contain plugins: the folder in the environment, then beside the
/// executable as installed and as built, then the folder from a program linked with this library.
std::vector<fs::path> plugin_folders() {
  std::vector<fs::path> folders;
  if (const char* named = std::getenv("REGULUS_PLUGINS"); named && *named)
    folders.emplace_back(named);
  if (const fs::path folder = folder_of_executable(); !folder.empty()) {
    folders.push_back(folder / "../lib/regulus/plugins");
    folders.push_back(folder / "../lib");
  }
  if (const std::string linked = regulus_plugin_folder(); !linked.empty())
    folders.emplace_back(linked);
  return folders;
}

void* find_function(void* library, const char* name) {
  void* found = ::dlsym(library, name);
  if (!found) throw CompilerUnavailable(std::string("the compiler plugin has no ") + name);
  return found;
}

}  // namespace

std::string file_identity(const std::filesystem::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return file.string() + " absent";
  return file.string() + " " + std::to_string(status.st_size) + " " +
         std::to_string(status.st_mtim.tv_sec) + "." + std::to_string(status.st_mtim.tv_nsec);
}

std::filesystem::path find_plugin(const char* file) {
  std::error_code error;
  for (const fs::path& folder : plugin_folders())
    if (fs::exists(folder / file, error)) return folder / file;
  return file;
}

/// The handle is never closed: LLVM cannot be unloaded, and opening it again costs nothing.
void* open_plugin(const std::filesystem::path& plugin, const char* symbol, double& seconds) {
  const auto start = std::chrono::steady_clock::now();
  void* library = ::dlopen(plugin.c_str(), RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
  if (!library) {
    const char* reason = ::dlerror();
    throw CompilerUnavailable(std::string("the compiler plugin cannot be opened: ") +
                              (reason ? reason : plugin.string()) +
                              " (REGULUS_PLUGINS names the folder it is in)");
  }
  const auto version = reinterpret_cast<regulus_clang_interface_function>(
      find_function(library, REGULUS_CLANG_INTERFACE_SYMBOL));
  if (version() != REGULUS_CLANG_INTERFACE)
    throw CompilerUnavailable("the compiler plugin belongs to another version: " + plugin.string());
  void* function = find_function(library, symbol);
  seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return function;
}

void require_memory(int code) {
  if (code == REGULUS_CLANG_NO_MEMORY)
    throw CompilerUnavailable("there is not enough memory to compile (see ulimit -v)");
}

}  // namespace regulus::detail
