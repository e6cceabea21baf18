// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/question/engine/kernel_source.hpp"
#include "codegen/question/engine/warm_start.hpp"
#include "runtime/machine/pack_program.hpp"

namespace regulus::detail {

/// The entries in the cache of the questions with the same forms (forms_key.hpp): their warm start and
/// their kernel. The rules of trust are those of ObjectCache; an entry that is damaged, or from
/// another program, is treated as absent.
class ProblemCache {
 public:
  ProblemCache(const FormulationOptions& functions, Isa isa);

  struct Found {
    ReportLabels labels;
    Variety variety;
    std::optional<BallProgram> matrix;
    std::optional<CompiledKernel> kernel;  ///< null: a part of it is not in the cache
    machine::PackKernel program;
  };
  /// Finds what a question with the same forms has left. `natural` is the formulation of the request
  /// without the functions of a kernel. Returns nullopt also if a part of the kernel is missing,
  /// unless its program suffices.
  [[nodiscard]] std::optional<Found> find(const Request& request, const Formulation& natural,
                                          bool may_interpret);
  /// Returns the reason why an existing entry was not used; otherwise empty.
  [[nodiscard]] const std::string& note() const noexcept { return note_; }

  /// Keeps the forms of the question that find() looked for. If this fails, the next run forms them
  /// again.
  void keep(WarmStart forms, const machine::PackKernel& program) const;

 private:
  ObjectCache cache_;
  FormulationOptions functions_;
  Isa isa_;
  std::string key_;  ///< of the question's forms; empty before find()
  std::string note_;
};

}  // namespace regulus::detail
