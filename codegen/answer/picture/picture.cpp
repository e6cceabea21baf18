// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/picture/picture.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "codegen/answer/picture/gnuplot.hpp"
#include "codegen/answer/picture/plot.hpp"
#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/place_text.hpp"

namespace regulus::detail {
namespace {

/// The panels of a picture.
struct Grid {
  int columns = 1, rows = 1;
};

Grid grid_of(std::size_t panels) {
  Grid grid;
  while (std::size_t(grid.columns) * std::size_t(grid.rows) < panels)
    ++(grid.columns <= grid.rows ? grid.columns : grid.rows);
  return grid;
}

/// Each panel is as large as about half a picture of one.
std::string terminal(const std::string& file, Grid grid) {
  const double across = grid.columns == 1 ? 1 : 0.5 * grid.columns + 0.15;
  const double up = grid.columns == 1 ? 1 : 0.5 * grid.rows + 0.3;
  if (file.ends_with(".png"))
    return fmt::format(
        "set terminal pngcairo size {:.0f},{:.0f} font 'Sans,18' linewidth 1.8 pointscale "
        "1.8 noenhanced\n",
        1280 * across, 1000 * up);
  if (file.ends_with(".pdf"))
    return fmt::format("set terminal pdfcairo size {:.2f}in,{:.2f}in font 'Sans,11' noenhanced\n",
                       5.6 * across, 4.5 * up);
  return fmt::format(
      "set terminal svg size {:.0f},{:.0f} font 'Helvetica,Arial,sans-serif,14' noenhanced "
      "background '#ffffff'\n",
      720 * across, 580 * up);
}

/// Returns the motion parameters that are not drawn, with their values or ranges.
std::vector<std::string> describe_others(const PreparedSearch& p, const PictureOptions& options) {
  std::vector<std::string> words;
  bool projected = false;
  for (std::size_t k = 0; k < p.labels.variables.size(); ++k) {
    const VariableLabel& variable = p.labels.variables[k];
    const bool is_cut = !options.slices.empty() && options.slices.front().axis == k;
    if (!is_motion(variable) || is_cut || std::ranges::count(options.drawn, k) != 0) continue;
    const bool ranges = std::ranges::count(options.paving.axes, k) != 0;
    projected = projected || ranges;
    words.push_back(drawn_text(variable, p.variety.outer[k]));
  }
  if (projected)
    words.back() += options.shade == Shade::kShare
                        ? fmt::format(": the part that is {}", options.word(Claim::kFree))
                        : ": the worst of them";
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

std::string title(const PreparedSearch& p, const PictureOptions& options) {
  std::string text = Gnuplot::quoted(picture_title(p, options));
  for (const std::string& line : wrapped(describe_others(p, options)))
    text += ".newline." + Gnuplot::quoted(line);
  return text + '\n';
}

/// Says what the percentages of the legend are parts of.
std::string key_title(const PictureOptions& options) {
  const std::size_t ranges = options.paving.axes.size();
  if (options.shade == Shade::kShare) return "";
  return ranges == 1   ? "parts of the range"
         : ranges == 2 ? "parts of the area"
                       : fmt::format("parts of the {}-D volume", ranges);
}

std::string single_picture(const PreparedSearch& p, const PictureOptions& options,
                           const Volumes& volumes, const Canvas& canvas) {
  return "set title " + title(p, options) +
         (canvas.is_flat() ? curve_commands(p, options, volumes, canvas)
                           : map_commands(p, options, volumes, canvas, true));
}

/// Below one panel of many the texts of a legend stand one below the other.
std::size_t rows_of_legend(const PictureOptions& options, const Volumes& volumes) {
  constexpr std::size_t kShares = 3;
  const bool is_share = options.shade == Shade::kShare;
  std::size_t rows = (is_share ? kShares : 0) + (options.robot ? 1 : 0);
  for (const Claim claim : kDrawingOrder) {
    const bool is_told = !is_share || claim == Claim::kOutside || claim == Claim::kUnreachable;
    if (is_told && volumes.of(claim).boxes > 0) ++rows;
  }
  return rows;
}

/// The first panel has the legend of all.
std::string slice_pictures(const PreparedSearch& p, const PictureOptions& options,
                           const Volumes& volumes, const std::deque<Canvas>& canvases, Grid grid) {
  // In heights of a picture of one panel.
  constexpr double kAxis = 0.2, kHead = 0.12, kLine = 0.035, kLeft = 0.13;
  const double width = 0.5 * grid.columns + 0.15, height = 0.5 * grid.rows + 0.3;
  const double foot = kAxis + kLine * double(rows_of_legend(options, volumes));
  const double head = kHead + kLine * double(1 + wrapped(describe_others(p, options)).size());
  std::string text = fmt::format(
                         "set multiplot layout {},{} margins screen {:.3f},0.97,{:.3f},{:.3f} "
                         "spacing screen {:.3f},{:.3f} title ",
                         grid.rows, grid.columns, kLeft / width, foot / height, 1 - head / height,
                         0.20 / grid.columns, 0.34 / grid.rows) +
                     title(p, options);
  for (const Canvas& canvas : canvases) {
    const VariableLabel& variable = p.labels.variables[canvas.slice()->axis];
    text += "set title " + Gnuplot::quoted(drawn_text(variable, Interval(canvas.slice()->value))) +
            '\n' + map_commands(p, options, volumes, canvas, &canvas == &canvases.front()) +
            "unset key\n";
  }
  return text + "unset multiplot\n";
}

std::string head(const std::string& file, Grid grid, const std::string& across,
                 const std::string& legend) {
  return "set encoding utf8\nset minussign\n" + terminal(file, grid) + "newline = \"\\n\"\n" +
         Gnuplot::kQuoteCommand + "set xlabel " + Gnuplot::quoted(across) +
         "\nset key at screen 0.5, screen 0.02 center bottom horizontal Left reverse samplen 1.5 " +
         (legend.empty() ? "" : "title " + Gnuplot::quoted(legend)) +
         "\nset tics out nomirror\n"
         "set border linecolor rgb '#404040'\n";
}

}  // namespace

std::string picture_head(const std::string& file, const std::string& across,
                         const std::string& legend) {
  return head(file, {}, across, legend);
}

std::string picture_title(const PreparedSearch& p, const PictureOptions& options) {
  return fmt::format("{}, {}{}", p.labels.model, p.labels.motion, options.subject);
}

std::string picture_commands(const std::string& file, const PreparedSearch& p,
                             const PictureOptions& options, const Volumes& volumes,
                             const std::deque<Canvas>& canvases) {
  const Grid grid = grid_of(canvases.size());
  return head(file, grid, axis_of(p, options.drawn[0]).label(), key_title(options)) +
         (options.slices.empty() ? single_picture(p, options, volumes, canvases.front())
                                 : slice_pictures(p, options, volumes, canvases, grid));
}

}  // namespace regulus::detail
