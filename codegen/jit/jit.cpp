// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/jit/jit.hpp"

#include <chrono>
#include <span>

#include "regulus/codegen/jit/clang_compiler.hpp"
#include "regulus/codegen/jit/kernel_compilation.hpp"
#include "regulus/codegen/jit/object_bundle.hpp"
#include "regulus/codegen/jit/object_cache.hpp"
#include "regulus/kernel/self_test.hpp"

namespace regulus::codegen {
namespace {

/// Adds the time it lives to a number of seconds.
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

using LoadedObjects = std::vector<LoadedObject>;

/// An object may use what those before it export.
LoadedObjects load(std::string_view bundle, CompileReport& report) {
  const Timer timer(report.load_seconds);
  std::vector<ExternalSymbol> externals = kernel_externals();
  LoadedObjects loaded;
  const std::vector<std::string_view> objects = objects_in(bundle);
  loaded.reserve(objects.size());  // their names are referred to
  for (const std::string_view object : objects) {
    loaded.push_back(load_object(std::as_bytes(std::span(object)), externals));
    loaded.back().add_symbols_to(externals);
  }
  return loaded;
}

/// A cache entry that is sound but cannot be loaded is one more damaged entry.
std::optional<LoadedObjects> load_from_cache(const ObjectCache& cache, const std::string& key,
                                             CompiledParts* parts, CompileReport& report) {
  ObjectCache::Entry entry;
  {
    const Timer timer(report.cache_seconds);
    entry = cache.read(key);
  }
  report.cache_note = entry.note;
  if (!entry.object) return std::nullopt;
  try {
    LoadedObjects loaded = load(*entry.object, report);
    if (parts) parts->add(*entry.object);
    return loaded;
  } catch (const LoadError& error) {
    report.cache_note = error.what();
    return std::nullopt;
  }
}

/// The objects of a kernel with those of its functions that were known.
std::string completed(std::string object, CompiledParts* parts, CompileReport& report) {
  if (!parts) return object;
  CompiledParts::Count count;
  std::string whole = parts->complete(object, count);
  report.functions_compiled = count.compiled;
  report.functions_known = count.known;
  return whole;
}

std::string compile_object(const ClangCompiler& compiler, const Compilation& compilation,
                           CompiledParts* parts, CompileReport& report) {
  const std::string text(compilation.source.text);
  try {
    CompiledObject compiled = compiler.compile(compilation, parts);
    report.not_read = compiled.not_read;
    report.open_compiler_seconds = compiled.open_seconds;
    report.front_end_seconds = compiled.front_end_seconds;
    report.optimiser_seconds = compiled.optimiser_seconds;
    report.code_generation_seconds = compiled.code_generation_seconds;
    if (!compiled.object.empty()) return completed(std::move(compiled.object), parts, report);
    throw CompileError("the generated text does not compile:\n" + compiled.diagnostics,
                       compiled.diagnostics, text);
  } catch (const CompilerUnavailable& error) {
    throw NoCompiler(error.what());  // whatever the text is
  }
}

LoadedObjects load_fresh(const std::string& object, std::string_view text, CompileReport& report) {
  try {
    return load(object, report);
  } catch (const LoadError& error) {
    throw CompileError("the compiled text cannot be loaded: " + std::string(error.what()), {},
                       std::string(text));
  }
}

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

LoadedObjects compile_or_find(std::string_view text, const CompileOptions& options,
                              CompileReport& report) {
  const ClangCompiler compiler;
  const Compilation compilation = kernel_compilation(text, options.isa);
  const auto cache = open_cache(options, report);
  CompiledParts* const parts = options.parts;
  if (parts) parts->prepare(object_key(kernel_compilation({}, options.isa), compiler.identity()));
  if (!cache) return load_fresh(compile_object(compiler, compilation, parts, report), text, report);

  std::string& key = report.object_key;
  {
    const Timer timer(report.cache_seconds);
    key = object_key(compilation, compiler.identity());
  }
  if (auto found = load_from_cache(*cache, key, parts, report)) {
    report.cache = CacheUse::kHit;
    return std::move(*found);
  }
  report.cache = CacheUse::kMiss;
  const std::string object = compile_object(compiler, compilation, parts, report);
  LoadedObjects loaded = load_fresh(object, text, report);
  const Timer timer(report.cache_seconds);
  append_note(report, cache->write(key, object));
  return loaded;
}

}  // namespace

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

MachineCode compile_text(std::string_view text, const CompileOptions& options) {
  CompileReport report;
  std::optional<LoadedObjects> loaded;
  {
    const Timer timer(report.total_seconds);
    loaded.emplace(compile_or_find(text, options, report));
  }
  return MachineCode(std::move(*loaded), std::move(report));
}

KernelName name_of(const EmittedKernel& emitted) { return {emitted.symbol, emitted.identity}; }

const regulus_kernel* CompiledKernel::find(const MachineCode& code, const KernelName& name) {
  const auto* kernel =
      static_cast<const regulus_kernel*>(code.symbol(name.symbol, sizeof(regulus_kernel)));
  if (!kernel || kernel->abi != REGULUS_KERNEL_ABI) return nullptr;
  const bool is_meant = name.identity.empty() || kernel->identity == name.identity;
  return is_meant ? kernel : nullptr;
}

CompiledKernel compile_kernel(const EmittedKernel& emitted, const CompileOptions& options) {
  const KernelName wanted = name_of(emitted);
  MachineCode code = compile_text(emitted.source, options);
  const regulus_kernel* kernel = CompiledKernel::find(code, wanted);
  if (!kernel && code.report().cache == CacheUse::kHit) {
    CompileOptions anew = options;
    anew.use_cache = false;
    if (anew.parts) *anew.parts = {};  // the entry's functions, too, may be others
    code = compile_text(emitted.source, anew);
    kernel = CompiledKernel::find(code, wanted);
  }
  if (!kernel)
    throw CompileError("the generated text defines no kernel '" + emitted.symbol + "' of ABI " +
                           std::to_string(static_cast<int>(REGULUS_KERNEL_ABI)),
                       {}, emitted.source);
  return {std::move(code), kernel};
}

std::string kernel_object_key(const EmittedKernel& emitted, Isa isa) {
  return object_key(kernel_compilation(emitted.source, isa), ClangCompiler().identity());
}

std::optional<CompiledKernel> load_cached_kernel(const ObjectCache& cache, const std::string& key,
                                                 const KernelName& name) {
  CompileReport report;
  std::optional<LoadedObjects> loaded = load_from_cache(cache, key, nullptr, report);
  if (!loaded) return std::nullopt;
  report.cache = CacheUse::kHit;
  report.total_seconds = report.cache_seconds + report.load_seconds;
  report.object_key = key;
  MachineCode code(std::move(*loaded), std::move(report));
  const regulus_kernel* kernel = CompiledKernel::find(code, name);
  if (!kernel) return std::nullopt;
  return CompiledKernel(std::move(code), kernel);
}

std::string compiler_identity() { return ClangCompiler().identity(); }

std::optional<std::string> rounding_self_test(const CompileOptions& options) {
  CompileOptions alone = options;
  alone.parts = nullptr;
  const MachineCode code = compile_text(kSelfTestSource, alone);
  const auto function = reinterpret_cast<regulus_function>(code.symbol(kSelfTestSymbol));
  if (!function) throw CompileError("the self-test is missing", {}, kSelfTestSource);
  return check_self_test(function, options.isa);
}

}  // namespace regulus::codegen
