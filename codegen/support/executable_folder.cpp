// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/support/executable_folder.hpp"

#include <sys/auxv.h>

#include <system_error>

namespace regulus::detail {

namespace fs = std::filesystem;

fs::path folder_of_executable() {
  std::error_code error;
  fs::path executable = fs::read_symlink("/proc/self/exe", error);
  const auto* started = reinterpret_cast<const char*>(::getauxval(AT_EXECFN));
  if (error && started) executable = fs::canonical(started, error);
  return error ? fs::path() : executable.parent_path();
}

}  // namespace regulus::detail
