// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/engine/problem_cache.hpp"

#include "codegen/engine/build_id.hpp"
#include "codegen/support/sha256.hpp"
#include "runtime/machine/pack_file.hpp"

namespace regulus::inline engine {

ProblemCache::ProblemCache(std::string_view model_text, const ModelOptions& model,
                           const FormulationOptions& functions, Isa isa)
    : cache_(default_cache_directory()),
      isa_(isa),
      key_(warm_start_key(model_text, model, functions, isa, build_id(), compiler_identity())) {}

std::optional<ProblemCache::Found> ProblemCache::find(bool may_interpret) {
  const ObjectCache::Entry entry = cache_.read(key_);
  note_ = entry.note;
  if (!entry.object) return std::nullopt;
  std::optional<WarmStart> problem = read_warm_start(*entry.object);
  if (!problem) return std::nullopt;
  const ObjectCache::Entry bytes = cache_.read(problem->program_key);
  if (!bytes.object) return std::nullopt;
  std::optional<machine::PackKernel> program = machine::read_pack_kernel(*bytes.object);
  if (!program || !fits(*problem, *program)) return std::nullopt;
  CompileOptions options;
  options.isa = isa_;
  std::optional<CompiledKernel> kernel = find_cached_kernel(*program, options);
  if (!kernel && !may_interpret) return std::nullopt;
  return Found{std::move(*problem), std::move(kernel), std::move(*program)};
}

void ProblemCache::keep(WarmStart problem, const machine::PackKernel& program) const {
  const std::string bytes = machine::to_bytes(program);
  problem.program_key = sha256(bytes);
  problem.identity = program.identity;
  static_cast<void>(cache_.write({{problem.program_key, bytes}, {key_, to_text(problem)}}));
}

}  // namespace regulus::engine
