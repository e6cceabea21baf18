// SPDX-License-Identifier: GPL-3.0-or-later
// The choices for pictures of a paving: axes, slices and shades.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "codegen/answer/picture/picture_request.hpp"
#include "codegen/answer/report/paving_options.hpp"
#include "runtime/search/paving.hpp"

namespace regulus::detail {

/// A plane in which a motion parameter has one value.
struct Slice {
  std::size_t axis = 0;
  double value = 0;
};

/// Returns the word for the claim of a box.
using WordOfClaim = const char* (*)(Claim) noexcept;

struct PictureOptions {
  PavingOptions paving;
  std::vector<std::size_t> drawn;  ///< the motion parameters along the axes: two, or the only one
  std::vector<Slice> slices;       ///< a map for each of them; empty: one map
  Shade shade = Shade::kWorst;
  bool robot = false;  ///< drawn over the map
  WordOfClaim word = regulus::name;
  std::string subject{};  ///< of the question, for the title; empty: model and motion say it
};

/// Throws UsageError unless the name of the file ends as that of a picture.
void require_picture_format(const std::string& file);
/// Returns whether the file holds boxes in space, .vtu, and not a drawing.
[[nodiscard]] bool is_grid_file(const std::string& file);

/// Throws UsageError for an unknown axis or slice, and for a picture of nothing.
[[nodiscard]] PictureOptions resolve_pictures(const PictureRequest& request,
                                              const PavingOptions& paving,
                                              const SearchSubject& preparation);

}  // namespace regulus::detail
