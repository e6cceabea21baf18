// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/problem_cache.hpp"

#include "codegen/question/engine/build_id.hpp"
#include "codegen/question/engine/forms_key.hpp"
#include "runtime/files/sha256.hpp"
#include "runtime/machine/pack_file.hpp"

namespace regulus::detail {
ProblemCache::ProblemCache(const FormulationOptions& functions, Isa isa)
    : cache_(default_cache_directory()), functions_(functions), isa_(isa) {}

std::optional<ProblemCache::Found> ProblemCache::find(const Request& request,
                                                      const Formulation& natural,
                                                      bool may_interpret) {
  key_ = forms_key(natural, !request.motion.alpha.is_zero(), functions_, isa_, build_id(),
                   compiler_identity());
  const ObjectCache::Entry entry = cache_.read(key_);
  note_ = entry.note;
  std::optional<WarmStart> forms =
      entry.object ? read_warm_start(*entry.object) : std::optional<WarmStart>();
  if (!forms) return std::nullopt;
  const ObjectCache::Entry bytes = cache_.read(forms->program_key);
  if (!bytes.object) return std::nullopt;
  std::optional<machine::PackKernel> program = machine::read_pack_kernel(*bytes.object);
  ReportLabels labels = report_labels(request, natural);
  labels.detail = forms->detail;
  if (!program || !fits(*forms, *program, labels)) return std::nullopt;
  CompileOptions options;
  options.isa = isa_;
  std::optional<CompiledKernel> kernel = find_cached_kernel(*program, options);
  if (!kernel && !may_interpret) return std::nullopt;
  return Found{std::move(labels), enclose_variety(request.model, request.motion, natural.variables),
               std::move(forms->matrix), std::move(kernel), std::move(*program)};
}

void ProblemCache::keep(WarmStart forms, const machine::PackKernel& program) const {
  if (key_.empty()) return;
  const std::string bytes = machine::to_bytes(program);
  forms.program_key = sha256(bytes);
  forms.identity = program.identity;
  const std::string text = to_text(forms);
  const std::vector<ObjectCache::NamedObject> entries{{forms.program_key, bytes}, {key_, text}};
  static_cast<void>(cache_.write(entries));
}

}  // namespace regulus::detail
