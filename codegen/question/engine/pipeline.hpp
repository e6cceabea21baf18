// SPDX-License-Identifier: GPL-3.0-or-later
// Prepares a search from a model file.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "codegen/kernel/cpp/emitted_kernel.hpp"
#include "codegen/kernel/formulation/formulation.hpp"
#include "codegen/kernel/formulation/functions_needed.hpp"
#include "codegen/kernel/program/ball_program.hpp"
#include "codegen/model/request.hpp"
#include "codegen/question/engine/edited_kernel.hpp"
#include "codegen/question/engine/filter_file.hpp"
#include "codegen/question/engine/late_compilation.hpp"
#include "codegen/question/engine/loaded_kernel.hpp"
#include "codegen/question/engine/options.hpp"
#include "codegen/question/engine/search_subject.hpp"
#include "codegen/question/engine/stage_seconds.hpp"
#include "codegen/question/engine/symbolic_stages.hpp"
#include "codegen/support/stopwatch.hpp"
#include "runtime/kernel/isa.hpp"
#include "runtime/problem/problem.hpp"
#include "runtime/search/solver.hpp"

namespace regulus::detail {

/// The functions that are evaluated, and where they come from.
struct PreparedKernel {
  /// The program of a square matrix, with rows and columns scaled as in the kernel. The threads of
  /// a search evaluate it with more digits.
  std::optional<BallProgram> matrix;
  std::unique_ptr<LoadedKernel> kernel;
  bool is_interpreted = false;  ///< at first, if `late` is not null
  /// For Engine::kAuto with an interpreted kernel; null: the kernel is compiled or stays
  /// interpreted.
  std::unique_ptr<LateCompilation> late;
  /// It belongs to a kernel that a person has edited. The search decides by its functions alone then.
  std::optional<EditedText> text;
  std::vector<FilterFile> filters;  ///< in the order of Settings::filters
  Isa isa = Isa::kPortable;
  std::string cache;        ///< "hit", "miss" or "off"
  std::string no_compiler;  ///< why only the interpreter was left; otherwise empty
  std::string cache_note;   ///< why the cache could not be used; otherwise empty
  PartCount parts;          ///< of the kernel, with SearchOptions::parts
};

/// A preparation takes time, and may be stopped.
struct PreparationCourse {
  /// Without the time of `stages`, which may still increase.
  StageSeconds seconds;
  /// The reason why the search must not begin; nullopt: it may.
  std::optional<FormingStopped> stopped = {};
};

/// All that a search needs, and the report about it. What needs a part alone takes that part.
struct PreparedSearch : SearchSubject, PreparedKernel, PreparationCourse {
  std::unique_ptr<SymbolicStages> stages;
  Solver solver = {};  ///< of this kernel, for one search after another
  long bits = 53;      ///< the most that the search computed with

  /// Refers to the kernels of this preparation.
  [[nodiscard]] Problem problem() const;
  /// Returns the time spent until now.
  [[nodiscard]] StageSeconds seconds_spent() const;
};

/// Runs every stage before the search, or takes the results of an earlier run from the cache.
/// Throws FileError, InputError, ClosedFormError, CompileError and InternalError.
///
/// The stages between the reading of the model and the compiler end at the time limit of `search`,
/// counted from here, or if `watch` stops them. Then PreparedSearch::stopped is set, and the result
/// can be used for a report.
[[nodiscard]] PreparedSearch prepare(const ModelOptions& model, const SearchOptions& search,
                                     FormingWatch watch = {});
/// Overload for a request that has been read in `model_seconds`.
[[nodiscard]] PreparedSearch prepare(Request request, double model_seconds,
                                     const SearchOptions& search, FormingWatch watch = {});

/// Returns the C++ text of a request's kernel, as `check` compiles it.
[[nodiscard]] EmittedKernel emit_kernel(const Request& request, Method method,
                                        const std::string& command,
                                        std::uint64_t symbolic_budget = kDeterminantBudget);

}  // namespace regulus::detail
