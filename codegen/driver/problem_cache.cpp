// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/problem_cache.hpp"

#include "regulus/codegen/driver/program_identity.hpp"

namespace regulus::codegen {

ProblemCache::ProblemCache(std::string_view model_text, const ModelOptions& model,
                           const FormulationOptions& functions, Isa isa)
    : cache_(default_cache_directory()),
      key_(prepared_problem_key(model_text, model, functions, isa, program_identity(),
                                compiler_identity())) {}

std::optional<ProblemCache::Found> ProblemCache::find() {
  const ObjectCache::Entry entry = cache_.read(key_);
  note_ = entry.note;
  if (!entry.object) return std::nullopt;
  std::optional<PreparedProblem> problem = read_prepared_problem(*entry.object);
  if (!problem) return std::nullopt;
  std::optional<CompiledKernel> kernel =
      load_cached_kernel(cache_, problem->object_key, problem->kernel);
  if (!kernel || !fits(*problem, *kernel->kernel())) return std::nullopt;
  return Found{std::move(*problem), std::move(*kernel)};
}

void ProblemCache::keep(const PreparedProblem& problem) const {
  static_cast<void>(cache_.write(key_, to_text(problem)));
}

}  // namespace regulus::codegen
