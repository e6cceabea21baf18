// SPDX-License-Identifier: GPL-3.0-or-later
// From a model file to something that can be searched.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "codegen/cpp/emitted_kernel.hpp"
#include "codegen/engine/filter_file.hpp"
#include "codegen/engine/late_compilation.hpp"
#include "codegen/engine/loaded_kernel.hpp"
#include "codegen/engine/options.hpp"
#include "codegen/engine/report_labels.hpp"
#include "codegen/engine/symbolic_stages.hpp"
#include "codegen/formulation/formulation.hpp"
#include "codegen/formulation/functions_needed.hpp"
#include "codegen/formulation/variety.hpp"
#include "codegen/model/request.hpp"
#include "codegen/program/ball_program.hpp"
#include "codegen/support/stopwatch.hpp"
#include "runtime/kernel/isa.hpp"
#include "runtime/problem/problem.hpp"

namespace regulus::inline engine {

/// Seconds spent in each stage.
struct StageSeconds {
  double model = 0;
  double symbolic = 0;
  double emit = 0;
  double compile = 0;
  double search = 0;
};

/// Everything a check needs, and what the report says about how it came about.
struct PreparedSearch {
  ReportLabels labels;
  Variety variety;
  bool is_replanned = false;  ///< the ranges or the threshold are not those that `stages` has
  /// The program of a square matrix, with its rows and columns scaled as the kernel has them. The
  /// threads of a search ask it with more digits.
  std::optional<BallProgram> matrix;
  std::unique_ptr<LoadedKernel> kernel;
  /// Of Engine::kAuto, where the kernel is interpreted; null: it is compiled or stays interpreted.
  std::unique_ptr<LateCompilation> late;
  std::vector<FilterFile> filters;  ///< in the order of Settings::filters
  Isa isa = Isa::kPortable;
  std::string cache;        ///< "hit", "miss" or "off"
  std::string no_compiler;  ///< why the interpreter was left; empty if it was not
  std::string cache_note;   ///< why the cache could not be used; empty if it could
  PartCount parts;          ///< of the kernel, with SearchOptions::parts
  long bits = 53;           ///< the most that the search computed with
  /// Without what `stages` has spent, which may still be going to be more.
  StageSeconds seconds;
  std::unique_ptr<SymbolicStages> stages;
  /// Why the search is not to begin; nullopt: it may.
  std::optional<FormingStopped> stopped = {};

  /// Refers to the kernels of this preparation.
  [[nodiscard]] Problem problem() const;
  /// What has been spent until now.
  [[nodiscard]] StageSeconds seconds_spent() const;
};

/// Runs every stage up to the search, or takes what an earlier run has kept of them. Throws
/// FileError, InputError, ClosedFormError, CompileError and InternalError too.
///
/// The stages between the reading of the model and the compiler end at the time limit of `search`,
/// counted from here, and when `watch` says so: then PreparedSearch::stopped is set, and what is
/// prepared is good for a report.
[[nodiscard]] PreparedSearch prepare(const ModelOptions& model, const SearchOptions& search,
                                     FormingWatch watch = {});
/// The same for a request that has been read, which took `model_seconds`; the engine `auto` waits
/// for the compiler here, whatever SearchOptions::boxes_before_compiling.
[[nodiscard]] PreparedSearch prepare(Request request, double model_seconds,
                                     const SearchOptions& search, FormingWatch watch = {});

/// The C++ text of a request's kernel, as `check` compiles it.
[[nodiscard]] EmittedKernel emit_kernel(const Request& request, Method method,
                                        const std::string& command,
                                        std::uint64_t symbolic_budget = kDeterminantBudget);

}  // namespace regulus::inline engine
