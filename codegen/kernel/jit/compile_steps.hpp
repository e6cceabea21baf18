// SPDX-License-Identifier: GPL-3.0-or-later
// Steps that the compilation of a text shares with that of a pack program.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "codegen/kernel/jit/jit.hpp"

namespace regulus::detail {

/// Adds its lifetime to a number of seconds.
class Timer {
 public:
  explicit Timer(double& seconds) noexcept : seconds_(seconds) {}
  ~Timer() {
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Opens the cache of the options, if it is wanted and usable; otherwise the report gives the
/// reason.
[[nodiscard]] std::optional<ObjectCache> open_cache(const CompileOptions& options,
                                                    CompileReport& report);

/// Adds a note on the cache to the report, if `note` is not empty.
void append_note(CompileReport& report, const std::string& note);

}  // namespace regulus::detail
