// SPDX-License-Identifier: GPL-3.0-or-later
// Draws a paving by gnuplot commands: coloured rectangles over two ranges, or the determinant over
// one.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "codegen/answer/picture/canvas.hpp"
#include "runtime/search/paving.hpp"

namespace regulus {

/// `canvases`: one for each slice, or one.
[[nodiscard]] std::string picture_commands(const std::string& file,
                                           const PreparedSearch& preparation,
                                           const PictureOptions& options, const Volumes& volumes,
                                           const std::deque<Canvas>& canvases);

}  // namespace regulus
