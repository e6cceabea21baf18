// SPDX-License-Identifier: GPL-3.0-or-later
// The folder of the compiler plugins, from the place of this module (codegen/kernel/jit/plugin_folder.h).
#include <dlfcn.h>

#include <filesystem>
#include <string>

#include "codegen/kernel/jit/plugin_folder.h"

namespace {

/// As installed in a system, in a wheel, and as built.
constexpr const char* kFolders[] = {"../../../regulus/plugins", "plugins", "../../lib"};

std::string find_folder() {
  Dl_info info{};
  if (::dladdr(reinterpret_cast<const void*>(&regulus_plugin_folder), &info) == 0) return "";
  const std::filesystem::path package = std::filesystem::path(info.dli_fname).parent_path();
  std::error_code error;
  for (const char* folder : kFolders)
    if (std::filesystem::exists(package / folder, error)) return (package / folder).string();
  return "";
}

}  // namespace

extern "C" const char* regulus_plugin_folder() {
  static const std::string folder = find_folder();
  return folder.c_str();
}
