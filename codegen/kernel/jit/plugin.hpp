// SPDX-License-Identifier: GPL-3.0-or-later
// The compiler plugins: 200 MB of libraries that a run with a warm cache never loads.
#pragma once

#include <cfenv>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "codegen/kernel/jit/clang_interface.h"

namespace regulus::detail {

/// The plugin cannot be opened, because the installation is incomplete, or memory ran out.
class CompilerUnavailable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns "PATH SIZE SECONDS.NANOSECONDS", or "PATH absent": it changes if the file is exchanged.
[[nodiscard]] std::string file_identity(const std::filesystem::path& file);

/// Returns the path of a plugin: in the folder of REGULUS_PLUGINS, or beside the installed or built
/// executable, or in regulus_plugin_folder(). If none has it, returns the file name to report as
/// missing.
[[nodiscard]] std::filesystem::path find_plugin(const char* file);

/// Returns the function of that name in the plugin. `seconds` is the time of loading.
/// Throws    CompilerUnavailable.
[[nodiscard]] void* open_plugin(const std::filesystem::path& plugin, const char* symbol,
                                double& seconds);

/// Throws    CompilerUnavailable if that is what a compilation returned.
void require_memory(int code);

/// Sets the default floating-point environment for its lifetime, whatever the caller or the
/// compiler sets.
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

}  // namespace regulus::detail
