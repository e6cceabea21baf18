// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/picture/plot.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "codegen/answer/picture/gnuplot.hpp"
#include "codegen/answer/report/paving_report.hpp"

namespace regulus::detail {
namespace {

constexpr const char* kInk = "#202020";
constexpr const char* kPaper = "#ffffff";

std::string line_style(double width, double dots, const char* colour, bool broken = false) {
  return fmt::format("linespoints linewidth {}{} pointtype 7 pointsize {} linecolor rgb '{}'",
                     width, broken ? " dashtype (12,6)" : "", dots, colour);
}

/// In pixels of the narrowest picture, an SVG of 720, by gnuplot's own guess of the width of its texts.
constexpr double kRoomOfLegend = 625, kWidthOfLetter = 9.8, kWidthOfSample = 45;

/// Returns how many texts of a legend stand side by side, the longest of which has that many letters.
std::size_t columns_of_legend(std::size_t longest) {
  constexpr std::size_t kMost = 3;
  const double width = kWidthOfSample + kWidthOfLetter * double(longest);
  return std::clamp(std::size_t(kRoomOfLegend / width), std::size_t(1), kMost);
}

}  // namespace

Plot::Plot(Axis across, Axis up) : across_(std::move(across)), up_(std::move(up)) {}

void Plot::begin_layer(const std::string& name, const std::string& colour) {
  name_ = name;
  colour_ = colour;
  lines_.clear();
}

/// Left, right, bottom and top on each line.
void Plot::add_rectangle(Interval x, Interval y) {
  lines_ += across_.ends(x) + ' ' + up_.ends(y) + '\n';
}

void Plot::end_layer() {
  if (lines_.empty()) return;
  blocks_ += fmt::format("${} << EOD\n{}EOD\n", name_, lines_);
  parts_.push_back(
      fmt::format("${} using (($1+$2)/2):(($3+$4)/2):1:2:3:4 with boxxyerror fillcolor rgb '{}' "
                  "fillstyle solid 1 noborder notitle",
                  name_, colour_));
}

void Plot::add_level(double y, bool broken) {
  const std::string ends = up_.ends(Interval(y));
  parts_.push_back(fmt::format("{} with lines linecolor rgb '#000000'{} notitle",
                               ends.substr(0, ends.find(' ')), broken ? " dashtype 2" : ""));
}

void Plot::add_path(std::vector<PlacePoint> points, PathStyle path) {
  if (points.empty()) return;
  const bool is_body = path == PathStyle::kBase || path == PathStyle::kPlatform;
  if (is_body) points.push_back(points.front());
  const std::string block = fmt::format("$path{}", ++paths_);
  blocks_ += block + " << EOD\n";
  for (const PlacePoint& p : points)
    blocks_ += fmt::format("{:.6g} {:.6g}\n", p.across * across_.factor(), p.up * up_.factor());
  blocks_ += "EOD\n";
  // Edges in the colour of the paper keep the line apart from every colour of the map.
  constexpr double kEdges = 2.5, kEdgeOfDot = 0.35;
  const double width = is_body || path == PathStyle::kRail ? 1.5 : 3;
  const double dots = path == PathStyle::kPlace ? 1.2 : 0.6;
  parts_.push_back(fmt::format("{} with {} notitle", block,
                               line_style(width + kEdges, dots + kEdgeOfDot, kPaper)));
  parts_.push_back(fmt::format("{} with {} notitle", block,
                               line_style(width, dots, kInk, path == PathStyle::kBase)));
}

void Plot::add_rod_legend(const std::string& text) {
  add_to_legend("keyentry with " + line_style(3, 0.6, kInk), text);
}

void Plot::add_legend(const std::string& colour, const std::string& text) {
  add_to_legend(fmt::format("keyentry with boxes fillcolor rgb '{}' fillstyle solid 1 border rgb "
                            "'#404040'",
                            colour),
                text);
}

void Plot::add_to_legend(const std::string& sample, const std::string& text) {
  parts_.push_back(sample + " title " + Gnuplot::quoted(text));
  ++texts_of_legend_;
  longest_of_legend_ = std::max(longest_of_legend_, text.size());
}

std::string Plot::legend_commands() const {
  // Ticks, the axis, a gap and the title of the legend.
  constexpr std::size_t kLinesAboveTexts = 6;
  const std::size_t columns = columns_of_legend(longest_of_legend_);
  return fmt::format("set key at graph 0.5, screen 0.02 maxcols {}\nset bmargin {}\n", columns,
                     kLinesAboveTexts + (texts_of_legend_ + columns - 1) / columns);
}

std::string Plot::commands() const {
  std::string text = across_.range_command("x") + up_.range_command("y") + blocks_ + "plot ";
  for (std::size_t i = 0; i < parts_.size(); ++i) text += (i > 0 ? ", \\\n  " : "") + parts_[i];
  return text + '\n';
}

const char* colour_of(Claim claim) {
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

void add_legends(Plot& plot, const PictureOptions& options, const Volumes& volumes) {
  for (const Claim claim :
       {Claim::kFree, Claim::kSingular, Claim::kUndecided, Claim::kOutside, Claim::kUnreachable})
    if (const Share& share = volumes.of(claim); share.boxes > 0)
      plot.add_legend(colour_of(claim),
                      fmt::format("{} {}", options.word(claim), percentage(volumes, share)));
}

Interval part_of(Interval range, std::size_t begin, std::size_t end, std::size_t count) {
  const double width = (range.hi - range.lo) / double(count);
  return {range.lo + double(begin) * width, range.lo + double(end) * width};
}

Interval overlapping(Interval part, Interval range, std::size_t count) {
  const double overlap = 0.1 * (range.hi - range.lo) / double(count);
  return {part.lo, std::min(part.hi + overlap, range.hi)};
}

}  // namespace regulus::detail
