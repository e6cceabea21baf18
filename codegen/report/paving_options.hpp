// SPDX-License-Identifier: GPL-3.0-or-later
// The options of a paving, resolved with the ranges of the model.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "codegen/engine/pipeline.hpp"

namespace regulus::inline report {

struct PavingOptions {
  double resolution = 1;          ///< part of each range
  std::vector<std::size_t> axes;  ///< the motion parameters that are not single values
  /// The axes to draw: two, or the only one; empty if there is none.
  std::vector<std::size_t> drawn;

  /// A paving of one range is drawn as the determinant over it, if the matrix has one.
  bool encloses_determinants = false;
};

/// The options as on the command line.
struct PavingRequest {
  std::string resolution{};  ///< part of each range, an expression; empty: by the number of ranges
  std::string axes{};        ///< "p,q"; empty: the first two that are not single values
  bool draws = false;        ///< pictures are wanted
};

/// Throws UsageError for an unknown axis, a resolution that is not in (0, 1], a picture of nothing,
/// or a search that would split uncertain quantities.
[[nodiscard]] PavingOptions resolve_paving(const PavingRequest& request,
                                           const SearchOptions& search,
                                           const PreparedSearch& preparation);

/// Changes the settings of a search for a paving.
void require_paving(const PavingOptions& options, Settings& settings);

}  // namespace regulus::report
