// SPDX-License-Identifier: GPL-3.0-or-later
// Machine code of the parts of pack programs, in memory.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "codegen/kernel/jit/memory_mapping.hpp"
#include "runtime/machine/step.hpp"

namespace regulus::detail {

/// One part of a function. `slots` has the values that parts keep for each other. `operations` is
/// the row `run` of the step_table of the part's instruction set, through which the part calls
/// operations that are too long to be copied. Returns the lanes where the part is undefined.
using PartFunction = unsigned (*)(const double* boxes, const double* points, machine::Slot* slots,
                                  double* out, const machine::StepFunction* operations);

/// The code of several parts in memory: readable and executable, and no longer writable.
class LoadedParts {
 public:
  /// Requires  flat codes of PartCompiler, in this run or in an earlier run of the same program.
  /// Throws    LoadError if the system refuses executable memory; std::bad_alloc.
  explicit LoadedParts(const std::vector<std::string>& codes);

  [[nodiscard]] PartFunction function(std::size_t part) const noexcept;

 private:
  std::vector<std::size_t> offsets_;
  MemoryMapping mapping_;
};

}  // namespace regulus::detail
