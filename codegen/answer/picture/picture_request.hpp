// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace regulus::detail {

/// The meaning of a tile's colour, about all boxes over it.
enum class Shade : std::uint8_t {
  kWorst,  ///< the worst claim of them
  kShare,  ///< the part of their volume that is free
};

/// The options as on the command line.
struct PictureRequest {
  std::vector<std::string> files{};  ///< .svg, .pdf, .png: a map or a curve; .vtu: boxes in space
  std::string axes{};    ///< "p,q"; empty: the first two that are not single values nor sliced
  std::string slices{};  ///< "p=N"; empty: one picture of all values
  Shade shade = Shade::kWorst;
  bool robot = false;           ///< draw the robot, too
  std::size_t map_columns = 0;  ///< of a map in text, of at most two ranges; 0: none
};

}  // namespace regulus::detail
