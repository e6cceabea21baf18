// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of a paving along way-points: a row for each segment, or for a few segments that follow
// each other, from left to right, in the colours of the claims. For drawing only.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "codegen/answer/picture/gnuplot.hpp"
#include "codegen/answer/picture/picture_options.hpp"
#include "codegen/question/way/trajectory_paving.hpp"

namespace regulus::detail {

/// A paving to be drawn.
struct DrawnStretches {
  std::string title;
  const Trajectory& trajectory;
  std::vector<PathStretch> stretches;  ///< in order, without gaps
  ClaimWord word;
};

/// Throws UsageError for options that such a picture does not have.
void require_way_pictures(const PictureRequest& request);

class WayPictures {
 public:
  /// Opens the files and starts gnuplot, so that errors are reported before the search. Throws
  /// FileError, and what require_way_pictures throws.
  explicit WayPictures(const PictureRequest& request);

  /// Throws FileError if a picture cannot be written.
  void draw(const DrawnStretches& paving);

 private:
  struct Drawing {
    std::string file;
    std::unique_ptr<Gnuplot> gnuplot;
  };
  std::vector<Drawing> drawings_;
};

/// Returns the commands of gnuplot.
[[nodiscard]] std::string way_picture_commands(const std::string& file,
                                               const DrawnStretches& paving);

}  // namespace regulus::detail
