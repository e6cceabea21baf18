// SPDX-License-Identifier: GPL-3.0-or-later
// The result of a compilation, and its cost.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "codegen/kernel/jit/loaded_text.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {

/// kOff: not requested, or no safe directory.
enum class CacheUse { kHit, kMiss, kOff };

/// "hit", "miss", "off".
[[nodiscard]] std::string_view name(CacheUse use) noexcept;

/// The number of parts of a pack program that had to be compiled, and of parts from earlier
/// kernels.
struct PartCount {
  std::size_t compiled = 0, known = 0;
};

struct CompileReport {
  CacheUse cache = CacheUse::kOff;
  std::string cache_note;    ///< a fault of the cache or of the entry; else empty
  std::string object_key;    ///< of a text: its key in the cache; empty if the cache is off
  PartCount parts;           ///< of a pack program
  double cache_seconds = 0;  ///< making the key, reading, writing
  double open_compiler_seconds = 0;
  double front_end_seconds = 0;
  double optimiser_seconds = 0;
  double code_generation_seconds = 0;
  double load_seconds = 0;
  double total_seconds = 0;
};

/// The code of one text; it stays in memory as long as one copy of this object lives.
class MachineCode {
 public:
  MachineCode(LoadedText object, CompileReport report)
      : object_(std::make_shared<const LoadedText>(std::move(object))),
        report_(std::move(report)) {}

  /// Returns the address of an extern "C" function or variable of at least `size` bytes; null if
  /// the text does not define it.
  [[nodiscard]] void* symbol(std::string_view name, std::size_t size = 1) const noexcept {
    return object_->find(name, size);
  }

  [[nodiscard]] const CompileReport& report() const noexcept { return report_; }
  [[nodiscard]] const std::shared_ptr<const LoadedText>& object() const noexcept { return object_; }

 private:
  std::shared_ptr<const LoadedText> object_;
  CompileReport report_;
};

}  // namespace regulus::detail
