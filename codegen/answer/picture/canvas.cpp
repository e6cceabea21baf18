// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/picture/canvas.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace regulus::detail {
namespace {

/// The most tiles along a range that a picture can show.
constexpr std::size_t kMostTiles = 512;

std::size_t tile_count(double resolution) {
  const auto parts = std::size_t(std::min(std::ceil(1 / resolution), double(kMostTiles)));
  return std::bit_ceil(parts);
}

constexpr std::uint8_t bit_of(Claim claim) {
  return std::uint8_t(1U << static_cast<unsigned>(claim));
}

}  // namespace

Canvas::Canvas(const PreparedSearch& preparation, const PictureOptions& options,
               std::optional<Slice> slice)
    : slice_(slice),
      drawn_(options.drawn),
      columns_(tile_count(options.paving.resolution)),
      rows_(options.drawn.size() > 1 ? columns_ : 1),
      tiles_(columns_ * rows_),
      volumes_(options.shade == Shade::kShare ? columns_ * rows_ : 0),
      determinants_(is_flat() ? columns_ : 0) {
  for (const std::size_t k : drawn_) ranges_.push_back(preparation.variety.outer[k]);
  for (const std::size_t k : options.paving.axes)
    if (std::ranges::count(drawn_, k) == 0 && !(slice && slice->axis == k)) hidden_.push_back(k);
  if (preparation.labels.reach > 0)
    claims_.emplace(preparation.problem(), preparation.labels.reach);
}

/// Boxes come from halving, tiles from multiplication: their edges agree except for rounding.
Canvas::Span Canvas::tiles(std::size_t axis, std::size_t count, Interval x) const noexcept {
  constexpr double kRounding = 1e-6;
  const Interval& range = ranges_[axis];
  const double scale = double(count) / (range.hi - range.lo);
  const double begin = std::floor((x.lo - range.lo) * scale + kRounding);
  const double end = std::ceil((x.hi - range.lo) * scale - kRounding);
  const auto first = std::size_t(std::clamp(begin, 0.0, double(count - 1)));
  return {first, std::clamp(std::size_t(std::max(end, 0.0)), first + 1, count)};
}

bool Canvas::meets_slice(std::span<const Interval> box) const noexcept {
  return !slice_ ||
         (box[slice_->axis].lo <= slice_->value && slice_->value <= box[slice_->axis].hi);
}

/// Returns the part of a tile, in [0, 1], that a box covers along an axis.
double Canvas::part_of_tile(std::size_t axis, std::size_t count, std::size_t tile,
                            Interval x) const noexcept {
  const Interval& range = ranges_[axis];
  const double scale = double(count) / (range.hi - range.lo);
  const double begin = std::max((x.lo - range.lo) * scale, double(tile));
  const double end = std::min((x.hi - range.lo) * scale, double(tile + 1));
  return std::clamp(end - begin, 0.0, 1.0);
}

void Canvas::add_volume(std::span<const Interval> box, Claim claim, Span across, Span up) noexcept {
  if (claim == Claim::kOutside || claim == Claim::kUnreachable) return;
  double depth = 1;
  for (const std::size_t k : hidden_) depth *= box[k].hi - box[k].lo;
  for (std::size_t row = up.begin; row < up.end; ++row)
    for (std::size_t column = across.begin; column < across.end; ++column) {
      const double volume = depth * part_of_tile(0, columns_, column, box[drawn_[0]]) *
                            part_of_tile(1, rows_, row, box[drawn_[1]]);
      Volume& tile = volumes_[row * columns_ + column];
      tile.all += volume;
      if (claim == Claim::kFree) tile.free += volume;
    }
}

void Canvas::paint(std::span<const Interval> box, Claim claim) noexcept {
  if (!meets_slice(box)) return;
  const Span across = tiles(0, columns_, box[drawn_[0]]);
  const Span up = rows_ > 1 ? tiles(1, rows_, box[drawn_[1]]) : Span{0, 1};
  for (std::size_t row = up.begin; row < up.end; ++row)
    for (std::size_t column = across.begin; column < across.end; ++column)
      tiles_[row * columns_ + column] |= bit_of(claim);
  if (!volumes_.empty()) add_volume(box, claim, across, up);
}

void Canvas::on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept {
  paint(box.box, claims_ ? claims_->of(box.box, rule) : claim_of(rule));
  if (!is_flat() || rule == Rule::kOutside) return;
  const Span across = tiles(0, columns_, box.box[drawn_[0]]);
  for (std::size_t column = across.begin; column < across.end; ++column) {
    DeterminantTile& tile = determinants_[column];
    if (!proof.determinant || !is_bounded(*proof.determinant)) {
      tile.unknown = true;
      continue;
    }
    tile.enclosure = tile.known ? hull(tile.enclosure, *proof.determinant) : *proof.determinant;
    tile.known = true;
  }
}

void Canvas::on_open(const OpenBox& box) noexcept {
  paint(box.box, Claim::kUndecided);
  if (!is_flat()) return;
  const Span across = tiles(0, columns_, box.box[drawn_[0]]);
  for (std::size_t column = across.begin; column < across.end; ++column)
    determinants_[column].unknown = true;
}

Claim Canvas::claim(std::size_t column, std::size_t row) const noexcept {
  const std::uint8_t seen = tiles_[row * columns_ + column];
  for (const Claim claim :
       {Claim::kSingular, Claim::kUndecided, Claim::kFree, Claim::kOutside, Claim::kUnreachable})
    if ((seen & bit_of(claim)) != 0) return claim;
  return Claim::kUndecided;
}

double Canvas::free_share(std::size_t column, std::size_t row) const noexcept {
  const Volume& tile = volumes_[row * columns_ + column];
  return tile.all > 0 ? tile.free / tile.all : -1;
}

std::vector<TileRectangle> Canvas::rectangles(Claim wanted) const {
  return rectangles(
      [&](std::size_t column, std::size_t row) { return claim(column, row) == wanted; });
}

/// Finds runs along each row, and joins a run with an equal run below.
std::vector<TileRectangle> Canvas::rectangles(const TilePredicate& wanted) const {
  std::vector<TileRectangle> done, growing;
  for (std::size_t row = 0; row < rows_; ++row) {
    std::vector<TileRectangle> runs;
    for (std::size_t column = 0; column < columns_; ++column) {
      if (!wanted(column, row)) continue;
      if (!runs.empty() && runs.back().right == column)
        ++runs.back().right;
      else
        runs.push_back({column, column + 1, row, row + 1});
    }
    for (const TileRectangle& below : growing) {
      const auto same = std::find_if(runs.begin(), runs.end(), [&](const TileRectangle& run) {
        return run.left == below.left && run.right == below.right;
      });
      if (same != runs.end())
        same->bottom = below.bottom;
      else
        done.push_back(below);
    }
    growing = std::move(runs);
  }
  done.insert(done.end(), growing.begin(), growing.end());
  return done;
}

}  // namespace regulus::detail
