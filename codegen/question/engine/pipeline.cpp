// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/pipeline.hpp"

#include <algorithm>
#include <functional>

#include "codegen/kernel/cpp/emit.hpp"
#include "codegen/kernel/jit/jit.hpp"
#include "codegen/kernel/pack/select.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/question/engine/ingredients.hpp"
#include "codegen/question/engine/kernel_source.hpp"
#include "codegen/question/engine/problem_cache.hpp"
#include "codegen/question/engine/settings.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/kernel/self_test.hpp"
#include "runtime/machine/machine_kernel.hpp"

namespace regulus::detail {
namespace {

class CompiledCode : public LoadedKernel {
 public:
  explicit CompiledCode(CompiledKernel code) : code_(std::move(code)) {}
  const regulus_kernel& functions() const noexcept override { return *code_.kernel(); }

 private:
  CompiledKernel code_;
};

class InterpretedList : public LoadedKernel {
 public:
  InterpretedList(const machine::PackKernel& program, Isa isa) : kernel_(program, isa) {}
  const regulus_kernel& functions() const noexcept override { return *kernel_.get(); }

 private:
  machine::MachineKernel kernel_;
};

Isa chosen_isa(const SearchOptions& search) {
  const Isa isa = search.isa.value_or(best_isa());
  if (!supported(isa))
    throw UsageError("--isa: this processor cannot run " + std::string(name(isa)));
  return isa;
}

CompileOptions compile_options(Isa isa, const SearchOptions& search) {
  CompileOptions options;
  options.isa = isa;
  options.use_cache = search.use_cache;
  options.parts = search.parts;
  return options;
}

/// Removes the names of model and motion, so a program depends only on its operations, and motions
/// with the same expressions share one entry of the cache.
Module anonymous(Module module) {
  module.model.clear();
  module.motion.clear();
  return module;
}

void interpret(const machine::PackKernel& program, PreparedSearch& p) {
  require_sound_rounding(self_test(p.isa));
  p.cache = name(CacheUse::kOff);
  p.kernel = std::make_unique<InterpretedList>(program, p.isa);
  p.is_interpreted = true;
}

/// The kernel is compiled only for a long search.
void interpret_first(const SharedProgram& program, PreparedSearch& p, const SearchOptions& search) {
  interpret(*program, p);
  const std::string refusal =
      search.use_cache ? ObjectCache(default_cache_directory()).refusal() : "";
  if (search.use_cache && refusal.empty()) p.cache = name(CacheUse::kMiss);
  p.cache_note = refusal;
  p.late = std::make_unique<LateCompilation>(program, search.boxes_before_compiling,
                                             compile_options(p.isa, search));
}

void use(CompiledKernel code, PreparedSearch& p) {
  p.cache = code.cache();
  p.cache_note = code.cache_note();
  p.parts = code.report().parts;
  p.kernel = std::make_unique<CompiledCode>(std::move(code));
  p.is_interpreted = false;
}

/// No other expressions of the model take part in the search, so that the claim is about one set of
/// functions.
void use_edited(const Module& module, PreparedSearch& p, const SearchOptions& search) {
  EditedKernel edited = compile_edited(search.kernel, module, compile_options(p.isa, search));
  if (const auto difference =
          find_difference(*edited.code.kernel(), module, p.variety.outer, p.isa))
    throw InputError::statement(search.kernel, 0,
                                "the text does not compute the model's functions: " + *difference,
                                "write the same functions in another form, or change the model");
  use(std::move(edited.code), p);
  p.text = std::move(edited.text);
  p.matrix.reset();
}

/// Without a compiler, the interpreter is used, so there is an answer anyway.
void compile_if_possible(const machine::PackKernel& program, PreparedSearch& p,
                         const SearchOptions& search) try {
  use(compile(program, compile_options(p.isa, search)), p);
} catch (const NoCompiler& error) {
  interpret(program, p);
  p.no_compiler = error.what();
}

/// Returns nullopt also if compiled code cannot be tested because there is no compiler.
std::optional<CompiledKernel> find_tested(const machine::PackKernel& program,
                                          const CompileOptions& options) try {
  std::optional<CompiledKernel> found =
      options.use_cache ? find_cached_kernel(program, options) : std::nullopt;
  if (found) require_sound_rounding(options);
  return found;
} catch (const NoCompiler&) {
  return std::nullopt;
}

void choose_engine(const SharedProgram& program, PreparedSearch& p, const SearchOptions& search) {
  const CompileOptions options = compile_options(p.isa, search);
  if (search.engine == Engine::kJit) return use(compile(*program, options), p);
  if (search.boxes_before_compiling == 0) return compile_if_possible(*program, p, search);
  if (auto found = find_tested(*program, options)) return use(std::move(*found), p);
  interpret_first(program, p, search);
}

/// Receives the program of a kernel.
using Keep = std::function<void(const machine::PackKernel&)>;

void make_kernel(PreparedSearch& p, const SearchOptions& search, const Keep& keep) {
  Stopwatch watch;
  p.isa = chosen_isa(search);
  const FormingWatch& forming = p.stages->watch();
  const Module module = anonymous(p.stages->module());
  if (!search.kernel.empty() && !p.stopped) {
    use_edited(module, p, search);
  } else if (search.engine == Engine::kClang) {
    const EmittedKernel text = emit(module, {}, &forming);
    p.seconds.emit += watch.lap();
    use(compile(text, compile_options(p.isa, search)), p);
  } else {
    const auto program =
        std::make_shared<const machine::PackKernel>(select(module, kOperationsPerPart, &forming));
    p.seconds.program += watch.lap();
    if (search.engine == Engine::kInterpreted || p.stopped) {
      interpret(*program, p);
    } else {
      keep(*program);
      choose_engine(program, p, search);
    }
  }
  (p.is_interpreted ? p.seconds.program : p.seconds.compile) += watch.lap();
}

void load_filters(PreparedSearch& p, const SearchOptions& search) {
  for (const std::string& path : search.filters) p.filters.emplace_back(path);
}

FormulationOptions functions_for(const SearchOptions& search) {
  FormulationOptions functions =
      functions_needed(search.method, settings_from(search), search.symbolic_budget);
  leave_out(search.without, functions);
  // Column operations are off: a user's filter expects the matrix as written.
  if (!search.filters.empty()) {
    functions.columns = ColumnSearch::kNone;
    functions.scaling = false;
  }
  functions.threshold = search.threshold;
  functions.counts_occurrences = false;
  return functions;
}

/// Adds the time limit of the search, counted from now. A limit that no clock reaches is no limit.
FormingWatch within_time_limit(FormingWatch watch, const SearchOptions& search) {
  const std::chrono::duration<double> limit(search.time_limit);
  if (search.time_limit == 0 || !(limit < std::chrono::hours(24 * 365 * 100))) return watch;
  watch.deadline = std::min(watch.deadline,
                            FormingWatch::Clock::now() +
                                std::chrono::duration_cast<FormingWatch::Clock::duration>(limit));
  return watch;
}

/// Runs every stage after the reading of the model, one after the other. Throws FormingStopped.
void form(PreparedSearch& p, const Request& request) {
  const Formulation& formulation = p.stages->formulation();
  static_cast<void>(p.stages->module());
  p.labels = report_labels(request, formulation);
  // Made here and not later in a search, because only this thread may use GiNaC and CLN.
  if (!p.stopped && p.labels.rows == p.labels.columns) p.matrix.emplace(p.stages->matrix());
  Stopwatch watch;
  p.variety = enclose_variety(request.model, request.motion, formulation.variables);
  p.seconds.symbolic += watch.lap();
}

/// Makes a kernel only for a report, not for a search.
void give_up(PreparedSearch& p, const Request& request, const SearchOptions& search) {
  p.stages->give_up();
  p.matrix.reset();
  form(p, request);
  SearchOptions interpreted = search;
  interpreted.engine = Engine::kInterpreted;
  make_kernel(p, interpreted, {});
}

/// Runs every stage, one after the other. Throws FormingStopped.
void prepare_anew(PreparedSearch& p, const SearchOptions& search, const Keep& keep) {
  const Request& request = p.stages->request();
  Stopwatch watch;
  load_filters(p, search);
  p.seconds.model += watch.lap();
  require_sound_rounding(self_test(Isa::kPortable));
  p.seconds.program += watch.lap();
  form(p, request);
  make_kernel(p, search, keep);
}

double seconds_before_the_search(const PreparedSearch& p) {
  return p.seconds_spent().before_search();
}

/// Runs `stages`. If they are stopped, leaves what a report needs.
void prepare_until_stopped(PreparedSearch& p, const SearchOptions& search,
                           const std::function<void()>& stages) {
  Stopwatch watch;
  const double before = seconds_before_the_search(p);
  try {
    stages();
  } catch (const FormingStopped& stopped) {
    const Request& request = p.stages->request();
    p.stopped = stopped;
    // The stopped stage has not reported its time.
    p.seconds.symbolic += std::max(0.0, watch.lap() - (seconds_before_the_search(p) - before));
    give_up(p, request, search);
  }
  // From here on the search checks the time, and reports must be complete.
  p.stages->watch({});
}

/// Returns the cache, if the search may use it. prepare_anew reports mistakes in the command line.
std::optional<ProblemCache> place_in_cache(const FormulationOptions& functions,
                                           const SearchOptions& search) {
  if (search.engine == Engine::kInterpreted || search.engine == Engine::kClang ||
      !search.kernel.empty() || !search.use_cache)
    return std::nullopt;
  const Isa isa = search.isa.value_or(best_isa());
  if (!supported(isa)) return std::nullopt;
  return std::optional<ProblemCache>(std::in_place, functions, isa);
}

/// Finds in the cache the forms that the question shares with an earlier one.
std::optional<ProblemCache::Found> find_in(ProblemCache& cache, PreparedSearch& p,
                                           const SearchOptions& search) {
  const bool may_interpret = search.engine == Engine::kAuto && search.boxes_before_compiling != 0;
  const Formulation& natural = p.stages->natural_formulation();
  Stopwatch watch;
  std::optional<ProblemCache::Found> found =
      cache.find(p.stages->request(), natural, may_interpret);
  p.seconds.symbolic += watch.lap();
  return found;
}

/// Takes the kernel from the cache: as machine code, or as a program for an engine that may
/// interpret. Returns false if it is not there. Throws FormingStopped.
bool take_from(ProblemCache& cache, PreparedSearch& p, const SearchOptions& search) try {
  std::optional<ProblemCache::Found> found = find_in(cache, p, search);
  if (!found) return false;
  Stopwatch watch;
  load_filters(p, search);
  p.labels = std::move(found->labels);
  p.variety = std::move(found->variety);
  p.matrix = std::move(found->matrix);
  p.isa = chosen_isa(search);
  require_sound_rounding(self_test(Isa::kPortable));
  if (found->kernel) {
    require_sound_rounding(compile_options(p.isa, search));
    use(std::move(*found->kernel), p);
  } else {
    interpret_first(std::make_shared<const machine::PackKernel>(std::move(found->program)), p,
                    search);
  }
  (p.is_interpreted ? p.seconds.symbolic : p.seconds.compile) += watch.lap();
  return true;
} catch (const NoCompiler&) {
  // The self-test could not be compiled: without it no compiled kernel is used.
  if (search.engine != Engine::kAuto) throw;
  p.filters.clear();
  return false;
}

}  // namespace

PreparedSearch prepare(const ModelOptions& model, const SearchOptions& search,
                       FormingWatch forming) {
  Stopwatch watch;
  PreparedSearch p;
  std::string text = model_text(model);
  const FormulationOptions functions = functions_for(search);
  std::optional<ProblemCache> cache = place_in_cache(functions, search);
  p.model_file = model.path;
  p.stages = std::make_unique<SymbolicStages>(std::move(text), model, functions);
  p.stages->watch(within_time_limit(std::move(forming), search));
  p.seconds.model = watch.lap();
  prepare_until_stopped(p, search, [&] {
    if (cache && take_from(*cache, p, search)) return;
    prepare_anew(p, search, [&](const machine::PackKernel& program) {
      if (cache) cache->keep({p.labels.detail, p.matrix, {}, {}}, program);
    });
  });
  if (cache && p.cache_note.empty()) p.cache_note = cache->note();
  return p;
}

PreparedSearch prepare(Request request, double model_seconds, const SearchOptions& search,
                       FormingWatch forming) {
  PreparedSearch p;
  p.model_file = request.model.path;
  p.stages =
      std::make_unique<SymbolicStages>(std::move(request), model_seconds, functions_for(search));
  p.stages->watch(within_time_limit(std::move(forming), search));
  prepare_until_stopped(p, search,
                        [&] { prepare_anew(p, search, [](const machine::PackKernel&) {}); });
  return p;
}

StageSeconds PreparedSearch::seconds_spent() const {
  StageSeconds spent = seconds;
  if (!stages) return spent;
  spent.model += stages->model_seconds();
  spent.symbolic += stages->symbolic_seconds();
  return spent;
}

Problem PreparedSearch::problem() const {
  Problem problem;
  problem.kernel = &kernel->functions();
  if (late) problem.faster_kernel = &late->kernel();
  problem.outer = variety.outer;
  problem.inner = variety.inner;
  problem.alpha = variety.alpha;
  problem.determinant_exponent = labels.determinant_exponent;
  // A user's test may look at any variable.
  if (filters.empty())
    for (const VariableLabel& v : labels.variables) problem.idle.push_back(v.is_idle ? 1 : 0);
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

}  // namespace regulus::detail
