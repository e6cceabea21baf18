// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "codegen/engine/kernel_source.hpp"
#include "codegen/engine/warm_start.hpp"
#include "runtime/machine/pack_program.hpp"

namespace regulus::inline engine {

/// The place in the cache of one question's prepared problem, and what it says of its kernel. Rules
/// of trust are those of ObjectCache; what is damaged, or was made by another program, is as good
/// as absent.
class ProblemCache {
 public:
  ProblemCache(std::string_view model_text, const ModelOptions& model,
               const FormulationOptions& functions, Isa isa);

  struct Found {
    WarmStart problem;
    std::optional<CompiledKernel> kernel;  ///< null: a part of it is not in the cache
    machine::PackKernel program;
  };
  /// nullopt also when a part of the kernel is not there, unless its program will do.
  [[nodiscard]] std::optional<Found> find(bool may_interpret);
  /// Why an entry that is there was not used; empty if that did not happen.
  [[nodiscard]] const std::string& note() const noexcept { return note_; }

  /// A problem that cannot be kept is prepared again the next time.
  void keep(WarmStart problem, const machine::PackKernel& program) const;

 private:
  ObjectCache cache_;
  Isa isa_;
  std::string key_;
  std::string note_;
};

}  // namespace regulus::inline engine
