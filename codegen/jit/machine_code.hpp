// SPDX-License-Identifier: GPL-3.0-or-later
// What compiling a text gives, and what it cost.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "regulus/codegen/jit/object_loader.hpp"

namespace regulus::codegen {

/// kOff: not asked for, or no directory that is safe to use.
enum class CacheUse { kHit, kMiss, kOff };

/// "hit", "miss", "off".
[[nodiscard]] std::string_view name(CacheUse use) noexcept;

struct CompileReport {
  CacheUse cache = CacheUse::kOff;
  std::string cache_note;  ///< what is wrong with the cache or was with the entry; else empty
  std::string not_read;    ///< why the text took a C++ compiler; empty for an emitted kernel
  std::string object_key;  ///< the name of the object in the cache; empty if that is off
  std::size_t functions_compiled = 0;  ///< with CompileOptions::parts
  std::size_t functions_known = 0;
  double cache_seconds = 0;  ///< making the key, reading, writing
  double open_compiler_seconds = 0;
  double front_end_seconds = 0;
  double optimiser_seconds = 0;
  double code_generation_seconds = 0;
  double load_seconds = 0;
  double total_seconds = 0;
};

/// The compiler refused a text, or produced what cannot be loaded. The texts are generated, so this
/// is a fault of the generator or of the installation, never of a model file.
class CompileError : public std::runtime_error {
 public:
  CompileError(const std::string& what, std::string diagnostics, std::string text)
      : std::runtime_error(what), diagnostics_(std::move(diagnostics)), text_(std::move(text)) {}

  [[nodiscard]] const std::string& diagnostics() const noexcept { return diagnostics_; }
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  std::string diagnostics_;
  std::string text_;
};

/// There is no compiler to be had: it cannot be opened, or the system has no process for it.
/// Nothing is wrong with the text.
class NoCompiler : public CompileError {
 public:
  explicit NoCompiler(const std::string& what) : CompileError(what, {}, {}) {}
};

/// The code of one text, in memory as long as one copy of this object lives.
class MachineCode {
 public:
  MachineCode(std::vector<LoadedObject> objects, CompileReport report)
      : objects_(std::make_shared<const std::vector<LoadedObject>>(std::move(objects))),
        report_(std::move(report)) {}

  /// The address of an extern "C" function or variable of at least `size` bytes; null if the text
  /// defines none.
  [[nodiscard]] void* symbol(std::string_view name, std::size_t size = 1) const noexcept {
    for (const LoadedObject& object : *objects_)
      if (void* found = object.find(name, size)) return found;
    return nullptr;
  }

  [[nodiscard]] const CompileReport& report() const noexcept { return report_; }

 private:
  std::shared_ptr<const std::vector<LoadedObject>> objects_;
  CompileReport report_;
};

}  // namespace regulus::codegen
