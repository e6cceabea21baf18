// SPDX-License-Identifier: GPL-3.0-or-later
// Curves: the determinant over the only range, as enclosures.
#include <algorithm>

#include "codegen/answer/picture/gnuplot.hpp"
#include "codegen/answer/picture/plot.hpp"

namespace regulus::detail {
namespace {

/// Returns the height of the picture: every enclosure and 0, with a margin.
Interval height(const Canvas& canvas, double alpha) {
  Interval all(-alpha, alpha);
  for (std::size_t column = 0; column < canvas.columns(); ++column)
    if (canvas.determinant(column).known) all = hull(all, canvas.determinant(column).enclosure);
  const double margin = all.lo < all.hi ? 0.05 * (all.hi - all.lo) : 1.0;
  return {all.lo - margin, all.hi + margin};
}

/// Widens a band that is narrower than a line to one line.
Interval visible(Interval band, Interval y) {
  const double line = 0.004 * (y.hi - y.lo);
  const double missing = std::max(0.0, line - (band.hi - band.lo));
  return {band.lo - missing / 2, band.hi + missing / 2};
}

/// Draws, over each tile, the enclosure of the determinant; over tiles without one, the full
/// height.
void add_bands(Plot& plot, const Canvas& canvas, Claim claim) {
  const Interval x = plot.across().range(), y = plot.up().range();
  const std::size_t count = canvas.columns();
  const auto has_band = [&](std::size_t column) {
    const DeterminantTile& tile = canvas.determinant(column);
    return tile.known && !tile.unknown;
  };
  for (std::size_t begin = 0, end; begin < count; begin = end) {
    end = begin + 1;
    if (canvas.claim(begin, 0) != claim) continue;
    const bool band = has_band(begin);
    while (!band && end < count && canvas.claim(end, 0) == claim && !has_band(end)) ++end;
    plot.add_rectangle(overlapping(part_of(x, begin, end, count), x, count),
                       band ? visible(canvas.determinant(begin).enclosure, y) : y);
  }
}

}  // namespace

std::string curve_commands(const PreparedSearch& p, const PictureOptions& options,
                           const Volumes& volumes, const Canvas& canvas) {
  const double alpha = p.variety.alpha.hi;
  Plot plot(axis_of(p, options.drawn[0]),
            {height(canvas, alpha), alpha > 0 ? "det J⁻¹" : "determinant of the matrix", ""});
  for (const Claim claim : kDrawingOrder) {
    plot.begin_layer(name(claim), colour_of(claim));
    add_bands(plot, canvas, claim);
    plot.end_layer();
  }
  const bool has_determinants = options.paving.encloses_determinants;
  if (has_determinants) {
    plot.add_level(0, false);
    if (alpha != 0)
      for (const double level : {alpha, -alpha}) plot.add_level(level, true);
  }
  add_legends(plot, options, volumes);
  return (has_determinants ? "set ylabel " + Gnuplot::quoted(plot.up().label()) + '\n'
                           : "unset ytics\n") +
         plot.legend_commands() + plot.commands();
}

}  // namespace regulus::detail
