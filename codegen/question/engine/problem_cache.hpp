// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "codegen/question/engine/kernel_source.hpp"
#include "codegen/question/engine/warm_start.hpp"
#include "runtime/machine/pack_program.hpp"

namespace regulus {

/// The entries in the cache of one question: its warm start, that of the questions with the same
/// forms, and their kernel. The rules of trust are those of ObjectCache; an entry that is damaged,
/// or from another program, is treated as absent.
class ProblemCache {
 public:
  ProblemCache(std::string_view model_text, const ModelOptions& model,
               const FormulationOptions& functions, Isa isa);

  struct Found {
    WarmStart problem;
    std::optional<CompiledKernel> kernel;  ///< null: a part of it is not in the cache
    machine::PackKernel program;
  };
  /// Returns nullopt also if a part of the kernel is missing, unless its program suffices.
  [[nodiscard]] std::optional<Found> find(bool may_interpret);
  /// Finds what another question with the same forms has left. Labels and variety are those of the
  /// request. `natural` is its formulation without the functions of a kernel.
  [[nodiscard]] std::optional<Found> find_shared(const Request& request, const Formulation& natural,
                                                 bool may_interpret);
  /// Returns the reason why an existing entry was not used; otherwise empty.
  [[nodiscard]] const std::string& note() const noexcept { return note_; }

  /// Keeps the problem. If this fails, the next run prepares it again.
  void keep(WarmStart problem, const machine::PackKernel& program) const;

 private:
  [[nodiscard]] std::optional<Found> find(const std::string& key, std::string_view prefix,
                                          bool may_interpret);

  ObjectCache cache_;
  FormulationOptions functions_;
  Isa isa_;
  std::string question_;
  std::string forms_;  ///< empty before find_shared()
  std::string note_;
};

}  // namespace regulus
