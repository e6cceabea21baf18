// SPDX-License-Identifier: GPL-3.0-or-later
// Maps: a plane of tiles over two ranges.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "codegen/answer/picture/gnuplot.hpp"
#include "codegen/answer/picture/plot.hpp"
#include "codegen/answer/picture/robot_in_map.hpp"

namespace regulus::detail {
namespace {

/// Tenths of a tile that are free: 0 is none, 10 is all, between them is some.
constexpr int kLevels = 10;

int level_of(double share) {
  if (share >= 1 - 1e-9) return kLevels;
  return share <= 0 ? 0 : std::clamp(int(std::ceil(share * kLevels)), 1, kLevels - 1);
}

/// From the colour of what is singular or undecided to the colour of what is free.
std::string colour_of_level(int level) {
  constexpr int kNone[] = {0xfd, 0xe7, 0xc8}, kAll[] = {0x0a, 0x6e, 0xb4};
  std::string colour = "#";
  for (int i = 0; i < 3; ++i)
    colour += fmt::format("{:02x}", kNone[i] + (kAll[i] - kNone[i]) * level / kLevels);
  return colour;
}

void add_tiles(Plot& plot, const Canvas& canvas, const std::vector<TileRectangle>& rectangles) {
  const Interval x = plot.across().range(), y = plot.up().range();
  for (const TileRectangle& r : rectangles)
    plot.add_rectangle(part_of(x, r.left, r.right, canvas.columns()),
                       overlapping(part_of(y, r.bottom, r.top, canvas.rows()), y, canvas.rows()));
}

/// Height of the room of a map by its width. A map of equal scales may fill a part of either.
constexpr double kShape = 0.75;

/// Returns the most ticks that have room along a part of an axis for `whole` of them.
int ticks_of_part(int whole, double part) {
  constexpr int kLeast = 3;
  return std::clamp(int(std::lround(whole * std::min(part, 1.0))), kLeast, whole);
}

/// The most frequent kind is one rectangle below the others.
void add_claims(Plot& plot, const Canvas& canvas) {
  const Claim whole =
      canvas.rectangles(Claim::kOutside).size() > canvas.rectangles(Claim::kFree).size()
          ? Claim::kOutside
          : Claim::kFree;
  plot.begin_layer(name(whole), colour_of(whole));
  plot.add_rectangle(plot.across().range(), plot.up().range());
  plot.end_layer();
  for (const Claim claim : kDrawingOrder) {
    if (claim == whole) continue;
    plot.begin_layer(name(claim), colour_of(claim));
    add_tiles(plot, canvas, canvas.rectangles(claim));
    plot.end_layer();
  }
}

void add_shares(Plot& plot, const Canvas& canvas) {
  for (const Claim claim : {Claim::kUnreachable, Claim::kOutside}) {
    plot.begin_layer(name(claim), colour_of(claim));
    add_tiles(plot, canvas, canvas.rectangles([&](std::size_t column, std::size_t row) {
      return canvas.free_share(column, row) < 0 && canvas.claim(column, row) == claim;
    }));
    plot.end_layer();
  }
  for (int level = 0; level <= kLevels; ++level) {
    plot.begin_layer(fmt::format("level{}", level), colour_of_level(level));
    add_tiles(plot, canvas, canvas.rectangles([&](std::size_t column, std::size_t row) {
      const double share = canvas.free_share(column, row);
      return share >= 0 && level_of(share) == level;
    }));
    plot.end_layer();
  }
}

void add_share_legends(Plot& plot, const PictureOptions& options, const Volumes& volumes) {
  const std::string certified = options.word(Claim::kFree);
  for (const int level : {0, 5, 10})
    plot.add_legend(colour_of_level(level), (level == 0    ? "nothing "
                                             : level == 10 ? "all "
                                                           : "half ") +
                                                certified);
  for (const Claim claim : {Claim::kOutside, Claim::kUnreachable})
    if (volumes.of(claim).boxes > 0) plot.add_legend(colour_of(claim), options.word(claim));
}

}  // namespace

std::string map_commands(const PreparedSearch& p, const PictureOptions& options,
                         const Volumes& volumes, const Canvas& canvas, bool has_legend) {
  std::optional<RobotInMap> robot;
  if (options.robot) robot.emplace(p, options);
  const auto shown = [&](std::size_t k) {
    return robot ? robot->extent(k) : p.variety.outer[options.drawn[k]];
  };
  const auto unit = [&](std::size_t k) { return p.labels.variables[options.drawn[k]].unit; };
  const Interval x = shown(0), y = shown(1);
  const double ratio = (y.hi - y.lo) / (x.hi - x.lo);
  const bool equal = unit(0) == unit(1) && (robot || (ratio > 0.4 && ratio < 2.5));
  const int most_ticks = options.slices.empty() ? 8 : 4;
  Plot plot(axis_of(p, options.drawn[0], ticks_of_part(most_ticks, equal ? kShape / ratio : 1), x),
            axis_of(p, options.drawn[1], ticks_of_part(most_ticks, equal ? ratio / kShape : 1), y));
  if (options.shade == Shade::kShare) {
    add_shares(plot, canvas);
    if (has_legend) add_share_legends(plot, options, volumes);
  } else {
    add_claims(plot, canvas);
    if (has_legend) add_legends(plot, options, volumes);
  }
  if (robot) robot->add_to(plot, canvas.slice(), has_legend);
  // Any setting of a legend shows it.
  const std::string legend = options.slices.empty() ? plot.legend_commands()
                             : has_legend           ? "set key maxcols 1\n"
                                                    : "";
  return "set xlabel " + Gnuplot::quoted(plot.across().label()) + "\nset ylabel " +
         Gnuplot::quoted(plot.up().label()) + '\n' + (equal ? "set size ratio -1\n" : "") + legend +
         plot.commands();
}

}  // namespace regulus::detail
