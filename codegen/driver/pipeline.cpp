// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/pipeline.hpp"

#include "regulus/codegen/driver/ingredients.hpp"
#include "regulus/codegen/driver/settings.hpp"
#include "regulus/codegen/emit/emit.hpp"
#include "regulus/codegen/jit/jit.hpp"
#include "regulus/codegen/model/errors.hpp"
#include "regulus/codegen/model/model_file.hpp"
#include "regulus/codegen/model/overrides.hpp"
#include "regulus/codegen/program/interpreted_kernel.hpp"
#include "regulus/kernel/self_test.hpp"

namespace regulus::codegen {
namespace {

class CompiledCode : public LoadedKernel {
 public:
  explicit CompiledCode(CompiledKernel code) : code_(std::move(code)) {}
  const regulus_kernel& functions() const noexcept override { return *code_.kernel(); }

 private:
  CompiledKernel code_;
};

class InterpretedPrograms : public LoadedKernel {
 public:
  explicit InterpretedPrograms(const Module& module) : kernel_(module) {}
  const regulus_kernel& functions() const noexcept override { return *kernel_.get(); }

 private:
  InterpretedKernel kernel_;
};

Isa chosen_isa(const SearchOptions& search) {
  if (search.isa.empty()) return best_isa();
  const Isa isa = parse_isa(search.isa).value();
  if (!supported(isa)) throw UsageError("--isa: this processor cannot run " + search.isa);
  return isa;
}

void require_sound_rounding(const std::optional<std::string>& failure) {
  if (failure) throw InternalError("the rounding self-test failed: " + *failure);
}

/// Without the names of model and motion: the text then depends on what is computed alone, and
/// motions of the same expressions share one entry of the cache.
Module anonymous(Module module) {
  module.model.clear();
  module.motion.clear();
  return module;
}

void load_kernel(Preparation& p, const SearchOptions& search) {
  Stopwatch watch;
  require_sound_rounding(self_test(Isa::kPortable));
  if (search.engine == Engine::kInterpreted) {
    p.isa = Isa::kPortable;
    p.cache = "off";
    p.kernel = std::make_unique<InterpretedPrograms>(p.module);
    p.seconds.compile = watch.lap();
    return;
  }
  p.isa = chosen_isa(search);
  const EmittedKernel text = emit(anonymous(p.module));
  p.seconds.emit = watch.lap();

  CompileOptions options;
  options.isa = p.isa;
  options.use_cache = search.use_cache;
  require_sound_rounding(rounding_self_test(options));
  CompiledKernel code = compile_kernel(text, options);
  p.cache = code.cache();
  p.cache_note = code.cache_note();
  p.kernel = std::make_unique<CompiledCode>(std::move(code));
  p.seconds.compile = watch.lap();
}

}  // namespace

std::pair<std::string, std::string> split_assignment(const std::string& text, const char* option) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError(std::string(option) + ": found '" + text + "', expected NAME=VALUE");
  return {text.substr(0, equals), text.substr(equals + 1)};
}

Request read_request(const ModelOptions& options) {
  Request request;
  request.model = load_model(options.path);
  for (const std::string& tolerance : options.tolerances) {
    const auto [groups, value] = split_assignment(tolerance, "--tolerance");
    from_option("--tolerance", [&] { set_tolerance(request.model, groups, value); });
  }
  from_option("MOTION", [&] { request.motion = find_motion(request.model, options.motion); });
  for (const std::string& range : options.ranges) {
    const auto [parameter, value] = split_assignment(range, "--range");
    from_option("--range", [&] { set_range(request.model, request.motion, parameter, value); });
  }
  if (!options.alpha.empty())
    from_option("--alpha", [&] { set_alpha(request.motion, options.alpha); });
  return request;
}

FormulationOptions functions_needed(Method method, const Settings& settings,
                                    std::uint64_t symbolic_budget) {
  const ProductForm form = form_of(method);
  const bool derivatives = settings.entries == Entries::kDerivatives;
  FormulationOptions options;
  if (method == Method::kAuto)
    options.expansion = settings.uncertainty == Uncertainty::kElements ? ExpansionForm::kAtNominal
                                                                       : ExpansionForm::kAtBox;
  options.left_product = form == ProductForm{ProductForm::Side::kLeft, false};
  options.right_product = form == ProductForm{ProductForm::Side::kRight, false};
  options.derivatives = options.left_product && (derivatives || method == Method::kAuto);
  options.matrix_derivatives = derivatives && !options.left_product;
  if (form.side == ProductForm::Side::kLeft)
    options.columns =
        method == Method::kAuto ? ColumnSearch::kSecondOrder : ColumnSearch::kFirstOrder;
  options.determinant = method == Method::kClosedForm;
  options.determinant_budget = symbolic_budget;
  return options;
}

Preparation prepare(const ModelOptions& model, const SearchOptions& search) {
  Stopwatch watch;
  Request request = read_request(model);
  return prepare(std::move(request), watch.lap(), search);
}

Preparation prepare(Request request, double model_seconds, const SearchOptions& search) {
  Preparation p;
  Stopwatch watch;
  p.request = std::move(request);
  for (const std::string& path : search.filters) p.filters.emplace_back(path);
  p.seconds.model = model_seconds + watch.lap();
  const Method method = parse_method(search.method).value();
  FormulationOptions functions =
      functions_needed(method, settings_from(search), search.symbolic_budget);
  leave_out(search.without, functions);
  // Who wrote a filter knows the model's own matrix.
  if (!search.filters.empty()) functions.columns = ColumnSearch::kNone;
  p.formulation = formulate(p.request.model, p.request.motion, functions);
  p.module = lower(p.formulation);
  p.variety = enclose_variety(p.request.model, p.request.motion, p.formulation);
  p.seconds.symbolic = watch.lap();
  load_kernel(p, search);
  return p;
}

Problem Preparation::problem() const {
  Problem problem;
  problem.kernel = &kernel->functions();
  problem.outer = variety.outer;
  problem.inner = variety.inner;
  problem.alpha = variety.alpha;
  return problem;
}

EmittedKernel emit_kernel(const Request& request, Method method, const std::string& command,
                          std::uint64_t symbolic_budget) {
  EmitOptions options;
  options.command = command;
  options.source = request.model.source;
  return emit(lower(formulate(request.model, request.motion,
                              functions_needed(method, Settings{}, symbolic_budget))),
              options);
}

}  // namespace regulus::codegen
