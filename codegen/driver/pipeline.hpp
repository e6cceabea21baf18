// SPDX-License-Identifier: GPL-3.0-or-later
// From a model file to something that can be searched.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include "regulus/codegen/driver/filter_file.hpp"
#include "regulus/codegen/driver/options.hpp"
#include "regulus/codegen/driver/variety.hpp"
#include "regulus/codegen/emit/emitted_kernel.hpp"
#include "regulus/codegen/model/errors.hpp"
#include "regulus/codegen/model/model.hpp"
#include "regulus/codegen/program/module.hpp"
#include "regulus/codegen/symbolic/formulation.hpp"
#include "regulus/kernel/abi.hpp"
#include "regulus/kernel/isa.hpp"
#include "regulus/search/problem.hpp"

namespace regulus::codegen {

/// Seconds spent in each stage.
struct StageSeconds {
  double model = 0;
  double symbolic = 0;
  double emit = 0;
  double compile = 0;
  double search = 0;
};

/// Something wrong with a command line that only the model can tell (an unknown motion, say).
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A model and the one motion to look at, with the command line's changes made.
struct Request {
  Model model;
  Motion motion;
};

/// Throws InputError or FileError for the file, UsageError for the options.
[[nodiscard]] Request read_request(const ModelOptions& options);

/// "GROUP=VALUE" in two. Throws UsageError naming the option.
[[nodiscard]] std::pair<std::string, std::string> split_assignment(const std::string& text,
                                                                   const char* option);

/// Runs an override; its complaints are about the command line, not about the model file.
template <class Change>
void from_option(const char* option, Change change) {
  try {
    change();
  } catch (const InputError& error) {
    throw UsageError(std::string(option) + ": " + error.what());
  }
}

/// Keeps what a kernel's functions need: compiled code, or programs to interpret.
class LoadedKernel {
 public:
  LoadedKernel() = default;
  LoadedKernel(const LoadedKernel&) = delete;
  LoadedKernel& operator=(const LoadedKernel&) = delete;
  virtual ~LoadedKernel() = default;
  [[nodiscard]] virtual const regulus_kernel& functions() const noexcept = 0;
};

/// Everything a check needs, and what the report says about how it came about.
struct Preparation {
  Request request;
  Formulation formulation;
  Module module;
  Variety variety;
  std::unique_ptr<LoadedKernel> kernel;
  std::vector<FilterFile> filters;  ///< in the order of Settings::filters
  Isa isa = Isa::kPortable;
  std::string cache;       ///< "hit", "miss" or "off"
  std::string cache_note;  ///< why the cache could not be used; empty if it could
  StageSeconds seconds;
  long bits = 53;  ///< the most that the search computed with

  /// Refers to the kernel of this preparation.
  [[nodiscard]] Problem problem() const;
};

/// Runs every stage up to the search. Throws FileError, InputError, ClosedFormError, CompileError
/// and InternalError too.
[[nodiscard]] Preparation prepare(const ModelOptions& model, const SearchOptions& search);
/// The same for a request that has been read, which took `model_seconds`.
[[nodiscard]] Preparation prepare(Request request, double model_seconds,
                                  const SearchOptions& search);

/// Which functions a method calls; the others need not be formed or compiled.
[[nodiscard]] FormulationOptions functions_needed(
    Method method, const Settings& settings = {},
    std::uint64_t symbolic_budget = kDeterminantBudget);

/// The C++ text of a request's kernel, as `check` compiles it.
[[nodiscard]] EmittedKernel emit_kernel(const Request& request, Method method,
                                        const std::string& command,
                                        std::uint64_t symbolic_budget = kDeterminantBudget);

/// Measures the time since its construction or the last lap.
class Stopwatch {
 public:
  [[nodiscard]] double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace regulus::codegen
