// SPDX-License-Identifier: GPL-3.0-or-later
// The options of a paving, resolved with the ranges of the model.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "codegen/question/engine/pipeline.hpp"

namespace regulus::detail {

struct PavingOptions {
  double resolution = 1;          ///< part of each range
  std::vector<std::size_t> axes;  ///< the motion parameters that are not single values

  /// A paving of one range has an enclosure of the determinant for each box, if the matrix has one.
  bool encloses_determinants = false;
};

/// Returns the value of --resolution. Throws UsageError unless it is in (0, 1].
[[nodiscard]] double read_resolution(const std::string& text);

/// `resolution` is a part of each range, an expression; empty: by the number of ranges. Throws
/// UsageError if it is not in (0, 1], and for a search that would split uncertain quantities.
[[nodiscard]] PavingOptions resolve_paving(const std::string& resolution,
                                           const SearchOptions& search,
                                           const PreparedSearch& preparation);

/// Changes the settings of a search for a paving.
void require_paving(const PavingOptions& options, Settings& settings);

}  // namespace regulus::detail
