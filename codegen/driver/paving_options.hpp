// SPDX-License-Identifier: GPL-3.0-or-later
// What a paving is asked for, once the model has told which ranges there are.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "regulus/codegen/driver/options.hpp"
#include "regulus/codegen/driver/pipeline.hpp"

namespace regulus::codegen {

struct PavingOptions {
  double resolution = 1;          ///< part of each range
  std::vector<std::size_t> axes;  ///< the motion parameters that are not single values
  /// Those to draw: two, or the only one; empty if there is none.
  std::vector<std::size_t> drawn;

  /// A paving of one range is drawn as the determinant over it, if the matrix has one.
  bool encloses_determinants = false;
};

/// Throws UsageError for an unknown axis or a resolution that is not in (0, 1].
[[nodiscard]] PavingOptions resolve_paving(const LocateCommand& command,
                                           const Preparation& preparation);

/// How the search has to run for it.
[[nodiscard]] Settings paving_settings(const LocateCommand& command, const PavingOptions& options);

}  // namespace regulus::codegen
