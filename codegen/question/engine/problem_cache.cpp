// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/problem_cache.hpp"

#include "codegen/question/engine/build_id.hpp"
#include "codegen/question/engine/forms_key.hpp"
#include "runtime/files/sha256.hpp"
#include "runtime/machine/pack_file.hpp"

namespace regulus {
namespace {

/// In front of the text of a warm start that is kept for all questions with its forms.
constexpr std::string_view kShared = "shared ";

}  // namespace

ProblemCache::ProblemCache(std::string_view model_text, const ModelOptions& model,
                           const FormulationOptions& functions, Isa isa)
    : cache_(default_cache_directory()),
      functions_(functions),
      isa_(isa),
      question_(
          warm_start_key(model_text, model, functions, isa, build_id(), compiler_identity())) {}

std::optional<ProblemCache::Found> ProblemCache::find(bool may_interpret) {
  return find(question_, "", may_interpret);
}

std::optional<ProblemCache::Found> ProblemCache::find_shared(const Request& request,
                                                             const Formulation& natural,
                                                             bool may_interpret) {
  forms_ = forms_key(natural, !request.motion.alpha.is_zero(), functions_, isa_, build_id(),
                     compiler_identity());
  std::optional<Found> found = find(forms_, kShared, may_interpret);
  if (!found) return found;
  WarmStart& problem = found->problem;
  ReportLabels labels = report_labels(request, natural);
  labels.detail = problem.labels.detail;
  problem.labels = std::move(labels);
  problem.variety = enclose_variety(request.model, request.motion, natural.variables);
  if (!fits(problem, found->program)) return std::nullopt;
  if (problem.labels.notes.empty()) static_cast<void>(cache_.write(question_, to_text(problem)));
  return found;
}

std::optional<ProblemCache::Found> ProblemCache::find(const std::string& key,
                                                      std::string_view prefix, bool may_interpret) {
  const ObjectCache::Entry entry = cache_.read(key);
  if (note_.empty()) note_ = entry.note;
  if (!entry.object || !entry.object->starts_with(prefix)) return std::nullopt;
  std::optional<WarmStart> problem =
      read_warm_start(std::string_view(*entry.object).substr(prefix.size()));
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
  const std::string text = to_text(problem), shared = std::string(kShared) + text;
  std::vector<ObjectCache::NamedObject> entries{{problem.program_key, bytes}};
  // A question with notes is read each time, so that they are given each time.
  if (problem.labels.notes.empty()) entries.push_back({question_, text});
  if (!forms_.empty()) entries.push_back({forms_, shared});
  static_cast<void>(cache_.write(entries));
}

}  // namespace regulus
