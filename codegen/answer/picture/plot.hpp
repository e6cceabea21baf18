// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of gnuplot's commands that all plots of a paving have: blocks of rectangles, layers in
// their colours, legends.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "codegen/answer/picture/axis.hpp"
#include "codegen/answer/picture/canvas.hpp"
#include "runtime/search/paving.hpp"

namespace regulus::detail {

/// A place in the units of the axes.
struct PlacePoint {
  double across = 0, up = 0;
};

/// A line shows these points; a place is one point.
enum class PathStyle : std::uint8_t { kBase, kPlatform, kRail, kRod, kPlace };

/// A plot that grows layer by layer. Later layers are drawn over earlier ones.
class Plot {
 public:
  Plot(Axis across, Axis up);

  /// Adds rectangles of one colour; `name` is a word of letters and digits.
  void begin_layer(const std::string& name, const std::string& colour);
  void add_rectangle(Interval x, Interval y);
  void end_layer();

  /// Adds a horizontal line; a broken one if `broken`.
  void add_level(double y, bool broken);
  /// Adds a line through points, with a dot on each; the edge of a body is closed, that of the base
  /// broken.
  void add_path(std::vector<PlacePoint> points, PathStyle path);
  /// Adds a line of the legend.
  void add_legend(const std::string& colour, const std::string& text);
  /// Adds a line of the legend for rods.
  void add_rod_legend(const std::string& text);

  [[nodiscard]] const Axis& across() const noexcept { return across_; }
  [[nodiscard]] const Axis& up() const noexcept { return up_; }
  [[nodiscard]] std::string commands() const;
  /// Returns the commands for the legend of a picture of one plot: its columns, its place below the
  /// middle of the plot, and a margin that has room for all of its rows.
  [[nodiscard]] std::string legend_commands() const;

 private:
  void add_to_legend(const std::string& sample, const std::string& text);

  Axis across_, up_;
  std::string name_, colour_, lines_;  ///< of the layer that is open
  std::string blocks_;
  std::vector<std::string> parts_;
  std::size_t paths_ = 0, texts_of_legend_ = 0, longest_of_legend_ = 0;
};

/// Returns the colour of a claim, after Okabe and Ito, for readers who cannot distinguish red and
/// green.
[[nodiscard]] const char* colour_of(Claim claim);

/// Adds a line for each claim that some box has, with the part of the volume.
void add_legends(Plot& plot, const PictureOptions& options, const Volumes& volumes);

/// Returns part [begin, end) of `count` equal parts of a range.
[[nodiscard]] Interval part_of(Interval range, std::size_t begin, std::size_t end,
                               std::size_t count);
/// Extends the part slightly under its neighbour, to avoid a visible hairline between them.
[[nodiscard]] Interval overlapping(Interval part, Interval range, std::size_t count);

/// Later kinds are drawn over earlier ones.
inline constexpr std::array kDrawingOrder{Claim::kFree, Claim::kUnreachable, Claim::kOutside,
                                          Claim::kUndecided, Claim::kSingular};

/// The commands of a map of two ranges, each tile coloured by the worst claim or by its share.
[[nodiscard]] std::string map_commands(const SearchSubject& preparation,
                                       const PictureOptions& options, const Volumes& volumes,
                                       const Canvas& canvas, bool has_legend);
/// The commands of the determinant over the only range.
[[nodiscard]] std::string curve_commands(const SearchSubject& preparation,
                                         const PictureOptions& options, const Volumes& volumes,
                                         const Canvas& canvas);

}  // namespace regulus::detail
