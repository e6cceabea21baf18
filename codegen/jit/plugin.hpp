// SPDX-License-Identifier: GPL-3.0-or-later
// The compiler plugins: 200 MB of libraries that a run with a warm cache never loads.
#pragma once

#include <cfenv>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "codegen/jit/clang_interface.h"

namespace regulus::inline jit {

/// The plugin cannot be opened: the installation is incomplete.
class CompilerUnavailable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// "PATH SIZE SECONDS.NANOSECONDS", or "PATH absent": changes when the file is exchanged.
[[nodiscard]] std::string file_identity(const std::filesystem::path& file);

/// The path of a plugin: in the folder that REGULUS_PLUGINS names, or beside the executable as it
/// is installed or built, or in regulus_plugin_folder(). Returns the file name to report as missing
/// when it is in none of them.
[[nodiscard]] std::filesystem::path find_plugin(const char* file);

/// The function of that name in the plugin. `seconds`: how long it took to have it.
/// Throws    CompilerUnavailable.
[[nodiscard]] void* open_plugin(const std::filesystem::path& plugin, const char* symbol,
                                double& seconds);

/// The default floating-point environment while it lives, whatever the caller or the compiler sets.
class DefaultFloatingPoint {
 public:
  DefaultFloatingPoint() noexcept {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultFloatingPoint() { std::fesetenv(&saved_); }
  DefaultFloatingPoint(const DefaultFloatingPoint&) = delete;
  DefaultFloatingPoint& operator=(const DefaultFloatingPoint&) = delete;

 private:
  std::fenv_t saved_;
};

}  // namespace regulus::inline jit
