// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/picture/way_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "codegen/answer/picture/picture.hpp"
#include "codegen/answer/picture/plot.hpp"
#include "codegen/answer/report/number_text.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

/// More rows would be too thin to see.
constexpr std::size_t kMostRows = 64;
constexpr std::size_t kMostTics = 12;
/// What is not free is drawn at least this part of a row wide, so that it can be seen.
constexpr double kLeastPart = 0.003;

/// Places on the trajectory, by number of segments from its beginning.
double along(const PathPlace& place) { return double(place.piece) + place.s; }

class Rows {
 public:
  explicit Rows(std::size_t segments)
      : a_row_((segments + kMostRows - 1) / kMostRows), rows_((segments + a_row_ - 1) / a_row_) {}

  [[nodiscard]] std::size_t a_row() const { return a_row_; }
  [[nodiscard]] std::size_t count() const { return rows_; }

  /// Adds the parts of a stretch in each row. The first row is at the top.
  void add(Plot& plot, const PathStretch& stretch) const {
    const double begin = along(stretch.begin), end = along(stretch.end), wide = double(a_row_);
    const auto last = std::min(std::size_t(end / wide), rows_ - 1);
    for (auto row = std::size_t(begin / wide); row <= last; ++row) {
      const double first = double(row) * wide;
      Interval x(std::clamp(begin - first, 0.0, wide), std::clamp(end - first, 0.0, wide));
      if (!(x.lo < x.hi)) continue;
      if (stretch.claim != Claim::kFree) x = widened(x);
      plot.add_rectangle(x, {-double(row) - 0.9, -double(row) - 0.1});
    }
  }

 private:
  [[nodiscard]] Interval widened(Interval x) const {
    const double wide = double(a_row_), least = kLeastPart * wide;
    const double more = std::max(0.0, least - (x.hi - x.lo)) / 2;
    return {std::max(0.0, x.lo - more), std::min(wide, x.hi + more)};
  }

  std::size_t a_row_, rows_;
};

/// "12", or "12, t = 0.11 s": the segment with which a row begins.
std::string row_text(const Trajectory& trajectory, std::size_t segment) {
  std::string text = std::to_string(segment + 1);
  if (trajectory.has_time)
    text += fmt::format(", t = {:.4g}{}", approx_time_at(trajectory, {segment, 0}),
                        unit_suffix(trajectory.time_unit));
  return text;
}

std::string tics(const Trajectory& trajectory, const Rows& rows) {
  const std::size_t step = (rows.count() + kMostTics - 1) / kMostTics;
  std::string text;
  for (std::size_t row = 0; row < rows.count(); row += step)
    text +=
        fmt::format("{}{} {}", text.empty() ? "" : ", ",
                    Gnuplot::quoted(row_text(trajectory, row * rows.a_row())), -double(row) - 0.5);
  return text;
}

std::string share_text(double share) {
  if (share <= 0 || share >= 1) return share <= 0 ? "0 %" : "100 %";
  return fmt::format("{:.3g} %", std::clamp(100 * share, 0.001, 99.9));
}

void add_legends(Plot& plot, const DrawnStretches& paving) {
  for (const Claim claim :
       {Claim::kFree, Claim::kSingular, Claim::kUndecided, Claim::kOutside, Claim::kUnreachable}) {
    const double share = approx_share_of(paving.trajectory, paving.stretches, claim);
    if (std::ranges::find(paving.stretches, claim, &PathStretch::claim) != paving.stretches.end())
      plot.add_legend(colour_of(claim),
                      fmt::format("{} {}", paving.word(claim), share_text(share)));
  }
}

}  // namespace

void require_way_pictures(const PictureRequest& request) {
  const bool has_choice = !request.axes.empty() || !request.slices.empty();
  if (has_choice || request.shade != Shade::kWorst || request.robot)
    throw UsageError(fmt::format(
        "--{}: a motion along way-points has no ranges; its picture has a row for each segment",
        !request.axes.empty()     ? "axes"
        : !request.slices.empty() ? "slices"
        : request.robot           ? "robot"
                                  : "shade"));
  for (const std::string& file : request.files)
    if (is_grid_file(file))
      throw UsageError(fmt::format(
          "--picture {}: boxes in space need three motion parameters with ranges; a motion along "
          "way-points is drawn as .svg, .pdf or .png",
          file));
}

WayPictures::WayPictures(const PictureRequest& request) {
  require_way_pictures(request);
  for (const std::string& file : request.files)
    drawings_.push_back({file, std::make_unique<Gnuplot>(file)});
}

void WayPictures::draw(const DrawnStretches& paving) {
  for (Drawing& drawing : drawings_)
    drawing.gnuplot->draw(way_picture_commands(drawing.file, paving), paving.title);
}

std::string way_picture_commands(const std::string& file, const DrawnStretches& paving) {
  const Trajectory& trajectory = paving.trajectory;
  const Rows rows(trajectory.pieces.size());
  const bool is_one = rows.a_row() == 1;
  Plot plot({{0, double(rows.a_row())},
             is_one ? "part of the segment" : "segments from the first of the row",
             ""},
            {{-double(rows.count()), 0}, is_one ? "segment" : "first segment of the row", "", 0});
  for (const Claim claim : kDrawingOrder) {
    plot.begin_layer(name(claim), colour_of(claim));
    for (const PathStretch& stretch : paving.stretches)
      if (stretch.claim == claim) rows.add(plot, stretch);
    plot.end_layer();
  }
  add_legends(plot, paving);
  return picture_head(file, plot.across().label(),
                      trajectory.has_time ? "parts of the time" : "parts of the segments") +
         "set title " + Gnuplot::quoted(paving.title) + '\n' + plot.legend_commands() +
         "set ylabel " + Gnuplot::quoted(plot.up().label()) + "\nset ytics (" +
         tics(trajectory, rows) + ")\n" + plot.commands();
}

}  // namespace regulus::detail
