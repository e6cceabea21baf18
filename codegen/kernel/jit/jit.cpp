// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/jit.hpp"

#include "codegen/kernel/jit/clang_compiler.hpp"
#include "codegen/kernel/jit/compile_steps.hpp"
#include "codegen/kernel/jit/part_compiler.hpp"
#include "runtime/kernel/self_test.hpp"
#include "runtime/machine/self_test_kernel.hpp"

namespace regulus::detail {

std::optional<ObjectCache> open_cache(const CompileOptions& options, CompileReport& report) {
  if (!options.use_cache) return std::nullopt;
  const Timer timer(report.cache_seconds);
  ObjectCache cache(options.cache_directory.empty() ? default_cache_directory()
                                                    : options.cache_directory);
  report.cache_note = cache.refusal();
  if (!cache.refusal().empty()) return std::nullopt;
  return cache;
}

void append_note(CompileReport& report, const std::string& note) {
  if (note.empty()) return;
  report.cache_note.append(report.cache_note.empty() ? "" : "; ").append(note);
}

std::string_view name(CacheUse use) noexcept {
  switch (use) {
    case CacheUse::kHit:
      return "hit";
    case CacheUse::kMiss:
      return "miss";
    case CacheUse::kOff:
      break;
  }
  return "off";
}

std::string compiler_identity() {
  return ClangCompiler().identity() + "; " + PartCompiler().identity();
}

std::optional<std::string> rounding_self_test(const CompileOptions& options) {
  const CompiledKernel kernel = compile_kernel(machine::self_test_kernel(), options);
  return machine::check_self_test(*kernel.kernel(), options.isa);
}

std::optional<std::string> text_rounding_self_test(const CompileOptions& options) {
  const MachineCode code = compile_text(kSelfTestSource, options);
  const auto function = reinterpret_cast<regulus_function>(code.symbol(kSelfTestSymbol));
  if (!function) throw CompileError("the self-test is missing", {}, kSelfTestSource);
  return check_self_test(function, options.isa);
}

}  // namespace regulus::detail
