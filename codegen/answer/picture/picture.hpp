// SPDX-License-Identifier: GPL-3.0-or-later
// Draws a paving by gnuplot commands: coloured rectangles over two ranges, or the determinant over
// one.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "codegen/answer/picture/canvas.hpp"
#include "runtime/search/paving.hpp"

namespace regulus::detail {

/// Returns the commands before those of a plot of one panel. `legend`: over the legend.
[[nodiscard]] std::string picture_head(const std::string& file, const std::string& across,
                                       const std::string& legend);

/// Returns the name of a picture: model, motion and subject.
[[nodiscard]] std::string picture_title(const PreparedSearch& preparation,
                                        const PictureOptions& options);

/// `canvases`: one for each slice, or one.
[[nodiscard]] std::string picture_commands(const std::string& file,
                                           const PreparedSearch& preparation,
                                           const PictureOptions& options, const Volumes& volumes,
                                           const std::deque<Canvas>& canvases);

}  // namespace regulus::detail
