// SPDX-License-Identifier: GPL-3.0-or-later
// The stages between the bytes of a model file and the programs of a kernel.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "codegen/formulation/formulation.hpp"
#include "codegen/model/request.hpp"
#include "codegen/program/module.hpp"
#include "codegen/program/work_meter.hpp"
#include "codegen/support/stopwatch.hpp"

namespace regulus::inline engine {

/// Each stage runs when its result is first asked for: a kernel from the cache needs none of them
/// until a report has to say what only the expressions can tell. Not for two threads at once.
///
/// Throws, where a stage runs: InputError, UsageError, ClosedFormError, FormingStopped.
class SymbolicStages {
 public:
  /// `text`: the bytes of the model file.
  SymbolicStages(std::string text, ModelOptions options, const FormulationOptions& functions)
      : text_(std::move(text)), options_(std::move(options)), functions_(functions) {}
  /// Of a request that has been read, which took `model_seconds`.
  SymbolicStages(Request request, double model_seconds, const FormulationOptions& functions)
      : functions_(functions), request_(std::move(request)), model_seconds_(model_seconds) {}

  [[nodiscard]] const Request& request();
  /// The model over its motion without the functions of a kernel, which take most of the time.
  /// Witnesses and reports go by it, so that they are the same however the kernel came about.
  [[nodiscard]] const Formulation& natural_formulation();
  /// The program of the matrix as the model writes it, scaled as that of the kernel is.
  [[nodiscard]] const Program& matrix();
  /// With every function of the kernel.
  [[nodiscard]] const Formulation& formulation();
  [[nodiscard]] const Module& module();

  /// From now on `watch` may stop the stages that follow the reading of the model.
  void watch(FormingWatch watch) { watch_ = std::move(watch); }
  [[nodiscard]] const FormingWatch& watch() const noexcept { return watch_; }
  /// From now on the forms are the variables and sizes alone, which takes no time; the kernel is
  /// undefined everywhere, and no watch is looked at.
  void give_up();

  /// What has been spent so far.
  [[nodiscard]] double model_seconds() const noexcept { return model_seconds_; }
  [[nodiscard]] double symbolic_seconds() const noexcept { return symbolic_seconds_; }
  [[nodiscard]] double seconds() const noexcept { return model_seconds_ + symbolic_seconds_; }

 private:
  template <class Result, class Make>
  const Result& made(std::optional<Result>& result, double& seconds, Make make) {
    if (result) return *result;
    Stopwatch watch;
    result.emplace(make());
    seconds += watch.lap();
    return *result;
  }

  std::string text_;
  ModelOptions options_;
  FormulationOptions functions_;
  std::optional<Request> request_;
  std::optional<Formulation> outline_, formulation_;
  std::optional<Program> matrix_;
  FormingWatch watch_;
  std::optional<Module> module_;
  double model_seconds_ = 0;
  double symbolic_seconds_ = 0;
};

}  // namespace regulus::inline engine
