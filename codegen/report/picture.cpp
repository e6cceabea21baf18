// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/report/picture.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "codegen/report/gnuplot.hpp"
#include "codegen/report/paving_report.hpp"
#include "codegen/report/report_parts.hpp"

namespace regulus::inline report {
namespace {

/// Later kinds are drawn over earlier ones. Colours after Okabe and Ito, for readers who cannot
/// distinguish red and green.
constexpr std::array kDrawingOrder{Claim::kFree, Claim::kUnreachable, Claim::kOutside,
                                   Claim::kUndecided, Claim::kSingular};

const char* colour(Claim claim) {
  switch (claim) {
    case Claim::kFree:
      return "#56b4e9";
    case Claim::kSingular:
      return "#d55e00";
    case Claim::kUndecided:
      return "#f0e442";
    case Claim::kOutside:
      return "#dddddd";
    case Claim::kUnreachable:
      return "#999999";
  }
  return "";
}

bool ends_with(const std::string& file, const char* ending) { return file.ends_with(ending); }

std::string terminal(const std::string& file) {
  return ends_with(file, ".png")
             ? "set terminal pngcairo size 1280,1000 font 'Sans,18' noenhanced\n"
             : "set terminal svg size 720,580 font 'Helvetica,Arial,sans-serif,14' noenhanced "
               "background '#ffffff'\n";
}

std::string label_of(const VariableLabel& variable) {
  const std::string unit = unit_suffix(variable.unit);
  return unit.empty() ? variable.name : fmt::format("{} ({})", variable.name, unit.substr(1));
}

/// Returns the motion parameters that are not drawn, with their values or ranges.
std::vector<std::string> others(const PreparedSearch& p, const PavingOptions& options) {
  std::vector<std::string> words;
  bool projected = false;
  for (std::size_t k = 0; k < p.labels.variables.size(); ++k) {
    const VariableLabel& variable = p.labels.variables[k];
    if (!is_motion(variable) || std::ranges::count(options.drawn, k) != 0) continue;
    const bool ranges = std::ranges::count(options.axes, k) != 0;
    projected = projected || ranges;
    words.push_back(fmt::format("{} {} {}{}", variable.name, ranges ? "in" : "=",
                                short_interval(p.variety.outer[k]), unit_suffix(variable.unit)));
  }
  if (projected) words.back() += ": the worst of them";
  return words;
}

/// Joins words with commas, in lines that fit over a picture.
std::vector<std::string> wrapped(const std::vector<std::string>& words) {
  constexpr std::size_t kLine = 70;
  std::vector<std::string> lines;
  for (const std::string& word : words) {
    if (!lines.empty()) lines.back() += ',';
    if (lines.empty() || lines.back().size() + word.size() > kLine)
      lines.push_back(word);
    else
      lines.back() += ' ' + word;
  }
  return lines;
}

std::string title(const PreparedSearch& p, const PavingOptions& options) {
  std::string text =
      "set title " + Gnuplot::quoted(fmt::format("{}, {}", p.labels.model, p.labels.motion));
  for (const std::string& line : wrapped(others(p, options)))
    text += ".newline." + Gnuplot::quoted(line);
  return text + '\n';
}

std::string range_of(const char* axis, Interval x) {
  return fmt::format("set {}range [{}:{}]\n", axis, x.lo, x.hi);
}

std::string data_name(Claim claim) { return fmt::format("${}", name(claim)); }

/// Returns a block of data with the name of its kind: left, right, bottom, top on each line.
std::string data_block(Claim claim, const std::string& lines) {
  return lines.empty() ? "" : fmt::format("{} << EOD\n{}EOD\n", data_name(claim), lines);
}

std::string plotted(Claim claim) {
  return fmt::format(
      "{} using (($1+$2)/2):(($3+$4)/2):1:2:3:4 with boxxyerror fillcolor rgb '{}' "
      "fillstyle solid 1 noborder notitle",
      data_name(claim), colour(claim));
}

std::string legend(const Volumes& volumes, Claim claim) {
  const Share& share = volumes.of(claim);
  return fmt::format(
      "keyentry with boxes fillcolor rgb '{}' fillstyle solid 1 border rgb '#404040' title {}",
      colour(claim),
      Gnuplot::quoted(fmt::format("{} {}", name(claim), percentage(volumes, share))));
}

/// Returns left, right, bottom, top in the units of the axes.
std::string corners(Interval x, Interval y) {
  return fmt::format("{:.9g} {:.9g} {:.9g} {:.9g}\n", x.lo, x.hi, y.lo, y.hi);
}

Interval part_of(Interval range, std::size_t begin, std::size_t end, std::size_t count) {
  const double width = (range.hi - range.lo) / double(count);
  return {range.lo + double(begin) * width, range.lo + double(end) * width};
}

/// Extends the part slightly under its neighbour, to avoid a visible hairline between them.
Interval overlapping(Interval part, Interval range, std::size_t count) {
  const double overlap = 0.1 * (range.hi - range.lo) / double(count);
  return {part.lo, std::min(part.hi + overlap, range.hi)};
}

std::string rectangles(const Canvas& canvas, Claim claim, Interval x, Interval y) {
  std::string lines;
  for (const TileRectangle& r : canvas.rectangles(claim)) {
    const Interval across = part_of(x, r.left, r.right, canvas.columns());
    const Interval up = part_of(y, r.bottom, r.top, canvas.rows());
    lines += corners(across, overlapping(up, y, canvas.rows()));
  }
  return lines;
}

/// Returns the most frequent kind; it is drawn as one rectangle below the others.
Claim background(const Canvas& canvas) {
  return canvas.rectangles(Claim::kOutside).size() > canvas.rectangles(Claim::kFree).size()
             ? Claim::kOutside
             : Claim::kFree;
}

std::string plot_command(const std::vector<std::string>& parts) {
  std::string text = "plot ";
  for (const std::string& part : parts) text += (text.size() > 5 ? ", \\\n  " : "") + part;
  return text + '\n';
}

void append_legends(std::vector<std::string>& parts, const Volumes& volumes) {
  for (const Claim claim :
       {Claim::kFree, Claim::kSingular, Claim::kUndecided, Claim::kOutside, Claim::kUnreachable})
    if (volumes.of(claim).boxes > 0) parts.push_back(legend(volumes, claim));
}

std::string areas(const PreparedSearch& p, const PavingOptions& options, const Volumes& volumes,
                  const Canvas& canvas) {
  const Interval x = p.variety.outer[options.drawn[0]];
  const Interval y = p.variety.outer[options.drawn[1]];
  std::string text = range_of("x", x) + range_of("y", y);
  const VariableLabel& across = p.labels.variables[options.drawn[0]];
  const VariableLabel& up = p.labels.variables[options.drawn[1]];
  text += "set ylabel " + Gnuplot::quoted(label_of(up)) + '\n';
  const double ratio = (y.hi - y.lo) / (x.hi - x.lo);
  if (across.unit == up.unit && ratio > 0.4 && ratio < 2.5) text += "set size ratio -1\n";
  const Claim whole = background(canvas);
  std::vector<std::string> parts;
  for (const Claim claim : kDrawingOrder) {
    const std::string lines = claim == whole ? corners(x, y) : rectangles(canvas, claim, x, y);
    text += data_block(claim, lines);
    if (!lines.empty()) parts.insert(claim == whole ? parts.begin() : parts.end(), plotted(claim));
  }
  append_legends(parts, volumes);
  return text + plot_command(parts);
}

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
std::string bands(const Canvas& canvas, Claim claim, Interval x, Interval y) {
  const std::size_t count = canvas.columns();
  const auto has_band = [&](std::size_t column) {
    const DeterminantTile& tile = canvas.determinant(column);
    return tile.known && !tile.unknown;
  };
  std::string lines;
  for (std::size_t begin = 0, end; begin < count; begin = end) {
    end = begin + 1;
    if (canvas.claim(begin, 0) != claim) continue;
    const bool band = has_band(begin);
    while (!band && end < count && canvas.claim(end, 0) == claim && !has_band(end)) ++end;
    lines += corners(overlapping(part_of(x, begin, end, count), x, count),
                     band ? visible(canvas.determinant(begin).enclosure, y) : y);
  }
  return lines;
}

/// Draws a line at 0, and broken lines at the threshold.
void append_levels(std::vector<std::string>& parts, double alpha) {
  parts.emplace_back("0 with lines linecolor rgb '#000000' notitle");
  if (alpha == 0) return;
  for (const double level : {alpha, -alpha})
    parts.push_back(fmt::format("{} with lines linecolor rgb '#000000' dashtype 2 notitle", level));
}

std::string curve(const PreparedSearch& p, const PavingOptions& options, const Volumes& volumes,
                  const Canvas& canvas) {
  const Interval x = p.variety.outer[options.drawn[0]];
  const double alpha = p.variety.alpha.hi;
  const Interval y = height(canvas, alpha);
  std::string text = range_of("x", x) + range_of("y", y);
  text += !options.encloses_determinants ? "unset ytics\n"
          : alpha > 0                    ? "set ylabel 'det J⁻¹'\n"
                                         : "set ylabel 'determinant of the matrix'\n";
  std::vector<std::string> parts;
  for (const Claim claim : kDrawingOrder) {
    const std::string lines = bands(canvas, claim, x, y);
    text += data_block(claim, lines);
    if (!lines.empty()) parts.push_back(plotted(claim));
  }
  if (options.encloses_determinants) append_levels(parts, alpha);
  append_legends(parts, volumes);
  return text + plot_command(parts);
}

}  // namespace

void require_picture_format(const std::string& file) {
  if (!ends_with(file, ".svg") && !ends_with(file, ".png"))
    throw UsageError("--picture: found '" + file + "', expected a name that ends in .svg or .png");
}

std::string picture_commands(const std::string& file, const PreparedSearch& p,
                             const PavingOptions& options, const Volumes& volumes,
                             const Canvas& canvas) {
  const std::string across = label_of(p.labels.variables[options.drawn[0]]);
  return "set encoding utf8\n" + terminal(file) + "newline = \"\\n\"\n" + title(p, options) +
         "set xlabel " + Gnuplot::quoted(across) +
         "\nset bmargin 6\nset key at screen 0.5, 0.035 center horizontal Left reverse samplen "
         "1.5\n"
         "set tics out nomirror\n"
         "set border linecolor rgb '#404040'\n" +
         (canvas.is_flat() ? curve(p, options, volumes, canvas)
                           : areas(p, options, volumes, canvas));
}

}  // namespace regulus::report
