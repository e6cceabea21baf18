// SPDX-License-Identifier: GPL-3.0-or-later
// Compiles C++ text to machine code, with Clang.
#include "codegen/kernel/jit/clang_compiler.hpp"
#include "codegen/kernel/jit/compile_steps.hpp"
#include "codegen/kernel/jit/kernel_compilation.hpp"
#include "codegen/kernel/jit/load_error.hpp"
#include "codegen/kernel/jit/plugin.hpp"

namespace regulus::detail {
namespace {

LoadedText load(const ClangCompiler& compiler, std::string_view object, CompileReport& report) try {
  const Timer timer(report.load_seconds);
  return compiler.load(object);
} catch (const CompilerUnavailable& error) {
  throw NoCompiler(error.what());
}

/// Treats a sound cache entry that cannot be loaded as a damaged entry.
std::optional<LoadedText> load_from_cache(const ClangCompiler& compiler, const ObjectCache& cache,
                                          const std::string& key, CompileReport& report) try {
  ObjectCache::Entry entry;
  {
    const Timer timer(report.cache_seconds);
    entry = cache.read(key);
  }
  report.cache_note = entry.note;
  if (!entry.object) return std::nullopt;
  return load(compiler, *entry.object, report);
} catch (const LoadError& error) {
  report.cache_note = error.what();
  return std::nullopt;
}

std::string compile_object(const ClangCompiler& compiler, const Compilation& compilation,
                           CompileReport& report) {
  try {
    CompiledObject compiled = compiler.compile(compilation);
    report.open_compiler_seconds = compiled.open_seconds;
    report.front_end_seconds = compiled.front_end_seconds;
    report.optimiser_seconds = compiled.optimiser_seconds;
    report.code_generation_seconds = compiled.code_generation_seconds;
    if (!compiled.object.empty()) return std::move(compiled.object);
    throw CompileError("the generated text does not compile:\n" + compiled.diagnostics,
                       compiled.diagnostics, std::string(compilation.source.text));
  } catch (const CompilerUnavailable& error) {
    throw NoCompiler(error.what());  // whatever the text is
  }
}

LoadedText load_fresh(const ClangCompiler& compiler, const std::string& object,
                      std::string_view text, CompileReport& report) try {
  return load(compiler, object, report);
} catch (const LoadError& error) {
  throw CompileError("the compiled text cannot be loaded: " + std::string(error.what()), {},
                     std::string(text));
}

LoadedText compile_or_find(std::string_view text, const CompileOptions& options,
                           CompileReport& report) {
  const ClangCompiler compiler;
  const Compilation compilation = kernel_compilation(text, options.isa);
  const auto cache = open_cache(options, report);
  if (!cache)
    return load_fresh(compiler, compile_object(compiler, compilation, report), text, report);
  {
    const Timer timer(report.cache_seconds);
    report.object_key = object_key(compilation, compiler.identity());
  }
  if (auto found = load_from_cache(compiler, *cache, report.object_key, report)) {
    report.cache = CacheUse::kHit;
    return std::move(*found);
  }
  report.cache = CacheUse::kMiss;
  const std::string object = compile_object(compiler, compilation, report);
  LoadedText loaded = load_fresh(compiler, object, text, report);
  const Timer timer(report.cache_seconds);
  append_note(report, cache->write(report.object_key, object));
  return loaded;
}

/// Returns null unless the code has that kernel, of this ABI. An object of another kernel is not
/// used, even if the cache has it under the right key.
const regulus_kernel* find(const MachineCode& code, const EmittedKernel& emitted) {
  const auto* kernel =
      static_cast<const regulus_kernel*>(code.symbol(emitted.symbol, sizeof(regulus_kernel)));
  if (!kernel || kernel->abi != REGULUS_KERNEL_ABI) return nullptr;
  const bool is_meant = emitted.identity.empty() || kernel->identity == emitted.identity;
  return is_meant ? kernel : nullptr;
}

}  // namespace

MachineCode compile_text(std::string_view text, const CompileOptions& options) {
  CompileReport report;
  std::optional<LoadedText> loaded;
  {
    const Timer timer(report.total_seconds);
    loaded.emplace(compile_or_find(text, options, report));
  }
  return MachineCode(std::move(*loaded), std::move(report));
}

CompiledKernel compile_kernel(const EmittedKernel& emitted, const CompileOptions& options) {
  MachineCode code = compile_text(emitted.source, options);
  const regulus_kernel* kernel = find(code, emitted);
  if (!kernel && code.report().cache == CacheUse::kHit) {
    CompileOptions anew = options;
    anew.use_cache = false;
    code = compile_text(emitted.source, anew);
    kernel = find(code, emitted);
  }
  if (!kernel)
    throw CompileError("the generated text defines no kernel '" + emitted.symbol + "' of ABI " +
                           std::to_string(static_cast<int>(REGULUS_KERNEL_ABI)),
                       {}, emitted.source);
  return {code.object(), kernel, code.report()};
}

}  // namespace regulus::detail
