// SPDX-License-Identifier: GPL-3.0-or-later
// The stages between the bytes of a model file and the programs of a kernel.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "codegen/kernel/formulation/formulation.hpp"
#include "codegen/kernel/program/module.hpp"
#include "codegen/model/request.hpp"
#include "codegen/support/stopwatch.hpp"
#include "codegen/support/work_meter.hpp"

namespace regulus::detail {

/// Each stage runs at the first request of its result. With a kernel from the cache none of them
/// runs until a report needs the expressions. Not for two threads at once.
///
/// A stage may throw InputError, UsageError, ClosedFormError and FormingStopped.
class SymbolicStages {
 public:
  /// `text`: the bytes of the model file.
  SymbolicStages(std::string text, ModelOptions options, const FormulationOptions& functions)
      : text_(std::move(text)), options_(std::move(options)), functions_(functions) {}
  /// For a request that has been read in `model_seconds`.
  SymbolicStages(Request request, double model_seconds, const FormulationOptions& functions)
      : functions_(functions), request_(std::move(request)), model_seconds_(model_seconds) {}

  [[nodiscard]] const Request& request();
  /// Returns the model over its motion without the functions of a kernel, which take most of the
  /// time. Witnesses and reports use it, so they do not depend on the origin of the kernel.
  [[nodiscard]] const Formulation& natural_formulation();
  /// Returns the same with the robot's own matrix, Model::jacobian, if the search has another one.
  [[nodiscard]] const Formulation& jacobian_formulation();
  /// Returns the program of the matrix as the model writes it, scaled as in the kernel.
  [[nodiscard]] const Program& matrix();
  /// Returns the formulation with every function of the kernel.
  [[nodiscard]] const Formulation& formulation();
  [[nodiscard]] const Module& module();

  /// From now on `watch` may stop the stages, and the reading of the model.
  void watch(FormingWatch watch) { watch_ = std::move(watch); }
  [[nodiscard]] const FormingWatch& watch() const noexcept { return watch_; }
  /// From now on the forms are only the variables and sizes, which takes no time; the kernel is
  /// undefined everywhere, and no watch is checked.
  void give_up();

  /// The time spent so far.
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
  std::optional<Formulation> outline_, jacobian_, formulation_;
  std::optional<Program> matrix_;
  FormingWatch watch_;
  std::optional<Module> module_;
  double model_seconds_ = 0;
  double symbolic_seconds_ = 0;
};

}  // namespace regulus::detail
