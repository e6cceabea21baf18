// SPDX-License-Identifier: GPL-3.0-or-later
// A paving over one or two ranges as a map of characters, for a terminal. For looking at only,
// without a claim.
#pragma once

#include <cstddef>
#include <string>

#include "codegen/answer/picture/canvas.hpp"

namespace regulus::detail {

/// Returns the lines of a map that is at most `columns` wide: a character says of the boxes there
/// what the colour of a tile says in a picture. The first line has the axes and the characters.
///
/// Requires  the canvas is that of one or two ranges, without a slice.
[[nodiscard]] std::string text_map(const SearchSubject& subject, const PictureOptions& options,
                                   const Canvas& canvas, std::size_t columns);

}  // namespace regulus::detail
