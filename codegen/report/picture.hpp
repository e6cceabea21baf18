// SPDX-License-Identifier: GPL-3.0-or-later
// Draws a paving by gnuplot commands: coloured rectangles over two ranges, or the determinant over
// one.
#pragma once

#include <string>

#include "codegen/report/canvas.hpp"

namespace regulus::inline report {

/// Throws UsageError unless the name of the file ends in .svg or .png.
void require_picture_format(const std::string& file);

[[nodiscard]] std::string picture_commands(const std::string& file,
                                           const PreparedSearch& preparation,
                                           const PavingOptions& options, const Volumes& volumes,
                                           const Canvas& canvas);

}  // namespace regulus::report
