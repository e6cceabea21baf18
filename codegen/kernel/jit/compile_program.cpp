// SPDX-License-Identifier: GPL-3.0-or-later
// Compiles a pack program to machine code, part by part.
#include <cstring>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "codegen/kernel/jit/cache/key_parts.hpp"
#include "codegen/kernel/jit/compile_steps.hpp"
#include "codegen/kernel/jit/load_error.hpp"
#include "codegen/kernel/jit/part.hpp"
#include "codegen/kernel/jit/part_code.hpp"
#include "codegen/kernel/jit/part_compiler.hpp"
#include "codegen/kernel/jit/plugin.hpp"
#include "runtime/machine/frame_slots.hpp"
#include "runtime/machine/kernel_table.hpp"

namespace regulus::detail {
namespace {

/// The parts of a kernel, each once.
struct PartList {
  std::string all;  ///< the name of all together in the cache
  std::vector<std::string> names, bytes;
  std::vector<std::string> codes;  ///< empty: not known yet
  std::array<std::vector<std::size_t>, kKernelFunctions.size()> of_function;
};

PartList parts_of(const machine::PackKernel& program, Isa isa, const std::string& compiler) {
  PartList list;
  std::map<std::string, std::size_t> number_of;
  for (std::size_t row = 0; row < program.functions.size(); ++row)
    for (std::size_t part = 0; part < program.functions[row].part_ends.size(); ++part) {
      std::string bytes = part_bytes(program.functions[row], part);
      const auto [place, is_new] = number_of.try_emplace(bytes, list.names.size());
      list.of_function[row].push_back(place->second);
      if (!is_new) continue;
      list.names.push_back(part_name(bytes, name(isa), compiler));
      list.bytes.push_back(std::move(bytes));
    }
  list.codes.resize(list.names.size());
  KeyParts all;
  all.add("all parts");
  all.add(list.names);
  list.all = all.key();
  return list;
}

/// In the cache, the name of a part precedes its code, so the code of another part is not used,
/// even under the right key. Returns the fault of an entry, if there is one.
std::string find_in_cache(const ObjectCache& cache, const std::string& name, std::string& code) {
  ObjectCache::Entry entry = cache.read(name);
  if (!entry.object) return entry.note;
  if (entry.object->size() <= name.size() || !entry.object->starts_with(name))
    return "cache entry belongs to another part";
  code = std::move(*entry.object);
  code.erase(0, name.size());
  return {};
}

/// Returns the codes of all parts for one entry of the cache: it is read faster than an entry of
/// each.
std::string all_codes(const PartList& list) {
  std::string bytes = list.all;
  for (const std::string& code : list.codes) {
    const std::uint64_t size = code.size();
    bytes.append(reinterpret_cast<const char*>(&size), sizeof size).append(code);
  }
  return bytes;
}

/// Returns true if the entry gave every part its code.
bool take_all_codes(PartList& list, std::string_view bytes) {
  if (!bytes.starts_with(list.all)) return false;
  bytes.remove_prefix(list.all.size());
  std::vector<std::string> codes;
  for (std::uint64_t size = 0; codes.size() < list.codes.size(); bytes.remove_prefix(size)) {
    if (bytes.size() < sizeof size) return false;
    std::memcpy(&size, bytes.data(), sizeof size);
    bytes.remove_prefix(sizeof size);
    if (size == 0 || size > bytes.size()) return false;
    codes.emplace_back(bytes.substr(0, size));
  }
  list.codes = std::move(codes);
  return bytes.empty();
}

bool find_whole(PartList& list, PartStore* store, const ObjectCache& cache, CompileReport& report) {
  const Timer timer(report.cache_seconds);
  const ObjectCache::Entry entry = cache.read(list.all);
  append_note(report, entry.note);
  if (!entry.object || !take_all_codes(list, *entry.object)) return false;
  if (store)
    for (std::size_t i = 0; i < list.names.size(); ++i) store->add(list.names[i], list.codes[i]);
  return true;
}

enum class Missing { kCompile, kGiveUp };

/// Gives the known parts their code. Returns the others; only the first of them if `what` is
/// kGiveUp.
std::vector<std::size_t> find_known(PartList& list, PartStore* store,
                                    const std::optional<ObjectCache>& cache, Missing what,
                                    CompileReport& report) {
  const Timer timer(report.cache_seconds);
  std::vector<std::size_t> missing;
  std::string note;
  for (std::size_t i = 0; i < list.names.size(); ++i) {
    if (what == Missing::kGiveUp && !missing.empty()) break;
    if (store)
      if (auto known = store->find(list.names[i])) {
        list.codes[i] = std::move(*known);
        continue;
      }
    if (cache) {
      const std::string wrong = find_in_cache(*cache, list.names[i], list.codes[i]);
      if (note.empty()) note = wrong;
    }
    if (list.codes[i].empty())
      missing.push_back(i);
    else if (store)
      store->add(list.names[i], list.codes[i]);
  }
  append_note(report, note);
  return missing;
}

void compile_missing(PartList& list, const std::vector<std::size_t>& missing,
                     const PartCompiler& compiler, Isa isa, CompileReport& report) try {
  std::vector<std::string_view> parts;
  for (const std::size_t i : missing) parts.emplace_back(list.bytes[i]);
  CompiledParts compiled = compiler.compile(parts, isa);
  if (compiled.codes.size() != missing.size())
    throw CompileError("the pack program does not compile: " + compiled.diagnostics,
                       compiled.diagnostics, {});
  report.open_compiler_seconds = compiled.open_seconds;
  report.front_end_seconds = compiled.front_end_seconds;
  report.code_generation_seconds = compiled.code_generation_seconds;
  for (std::size_t i = 0; i < missing.size(); ++i)
    list.codes[missing[i]] = std::move(compiled.codes[i]);
} catch (const CompilerUnavailable& error) {
  throw NoCompiler(error.what());
}

void keep(const PartList& list, const std::vector<std::size_t>& fresh, PartStore* store,
          const std::optional<ObjectCache>& cache, CompileReport& report) {
  const Timer timer(report.cache_seconds);
  if (store)
    for (const std::size_t i : fresh) store->add(list.names[i], list.codes[i]);
  if (!cache) return;
  std::vector<std::string> entries;
  std::vector<ObjectCache::NamedObject> objects;
  for (const std::size_t i : fresh) entries.push_back(list.names[i] + list.codes[i]);
  for (std::size_t i = 0; i < fresh.size(); ++i)
    objects.push_back({list.names[fresh[i]], entries[i]});
  const std::string all = all_codes(list);
  objects.push_back({list.all, all});
  append_note(report, cache->write(objects));
}

/// A function whose parts are machine code.
struct CompiledFunction {
  std::vector<PartFunction> parts;
  std::size_t slots = 0;
  const machine::StepFunction* operations = nullptr;

  [[nodiscard]] unsigned run(const double* boxes, const double* points,
                             double* out) const noexcept {
    return machine::with_slots(slots, [&](machine::Slot* kept) {
      unsigned undefined = 0;
      for (const PartFunction part : parts) undefined |= part(boxes, points, kept, out, operations);
      return undefined;
    });
  }
};

using Table = machine::KernelOf<CompiledFunction>;

Table::Functions functions_of(const machine::PackKernel& program, const PartList& list,
                              const LoadedParts& code, Isa isa) {
  Table::Functions functions;
  for (std::size_t row = 0; row < functions.size(); ++row) {
    CompiledFunction& function = functions[row];
    function.slots = program.functions[row].slots;
    function.operations = machine::step_table(isa).run.data();
    for (const std::size_t part : list.of_function[row])
      function.parts.push_back(code.function(part));
  }
  return functions;
}

/// Code and the table that calls it.
struct ProgramInMemory {
  ProgramInMemory(const machine::PackKernel& program, const PartList& list, Isa isa)
      : code(list.codes), table(program, isa, functions_of(program, list, code, isa)) {}

  LoadedParts code;
  Table table;
};

std::shared_ptr<const ProgramInMemory> load(const machine::PackKernel& program,
                                            const PartList& list, Isa isa,
                                            CompileReport& report) try {
  const Timer timer(report.load_seconds);
  return std::make_shared<const ProgramInMemory>(program, list, isa);
} catch (const LoadError& error) {
  throw CompileError(error.what(), {}, {});
}

std::optional<CompiledKernel> make_kernel(const machine::PackKernel& program,
                                          const CompileOptions& options, Missing what) {
  machine::require_no_fault(program);
  CompileReport report;
  std::shared_ptr<const ProgramInMemory> loaded;
  {
    const Timer timer(report.total_seconds);
    const PartCompiler compiler;
    PartList list = parts_of(program, options.isa, compiler.identity());
    const auto cache = open_cache(options, report);
    const bool whole = cache && find_whole(list, options.parts, *cache, report);
    std::vector<std::size_t> missing;
    if (!whole) missing = find_known(list, options.parts, cache, what, report);
    if (!missing.empty() && what == Missing::kGiveUp) return std::nullopt;
    if (!missing.empty()) compile_missing(list, missing, compiler, options.isa, report);
    loaded = load(program, list, options.isa, report);
    if (!whole) keep(list, missing, options.parts, cache, report);
    report.parts = {missing.size(), list.names.size() - missing.size()};
    if (cache) report.cache = missing.empty() ? CacheUse::kHit : CacheUse::kMiss;
  }
  const regulus_kernel* kernel = loaded->table.get();
  return CompiledKernel(std::move(loaded), kernel, std::move(report));
}

}  // namespace

CompiledKernel compile_kernel(const machine::PackKernel& program, const CompileOptions& options) {
  return std::move(make_kernel(program, options, Missing::kCompile)).value();
}

std::optional<CompiledKernel> find_cached_kernel(const machine::PackKernel& program,
                                                 const CompileOptions& options) {
  return make_kernel(program, options, Missing::kGiveUp);
}

}  // namespace regulus::detail
