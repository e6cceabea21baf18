// SPDX-License-Identifier: GPL-3.0-or-later
// The source of a picture: a raster over one or two ranges. Each box is painted on it at once, so
// memory does not grow with their number. For drawing only, without a claim.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "codegen/answer/picture/picture_options.hpp"
#include "runtime/search/leaf_claims.hpp"

namespace regulus::detail {

/// A rectangle of tiles of one kind, in tiles: columns [left, right), rows [bottom, top).
struct TileRectangle {
  std::size_t left, right, bottom, top;
};

/// The determinant over one tile of a single range.
struct DeterminantTile {
  Interval enclosure;
  bool known = false;    ///< some box over it has an enclosure
  bool unknown = false;  ///< some box over it has none
};

class Canvas final : public Observer {
 public:
  /// With a slice, boxes that the slice does not meet are left out.
  Canvas(const PreparedSearch& preparation, const PictureOptions& options,
         std::optional<Slice> slice = std::nullopt);

  void on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept override;
  void on_open(const OpenBox& box) noexcept override;

  [[nodiscard]] bool is_flat() const noexcept { return drawn_.size() < 2; }
  [[nodiscard]] std::size_t columns() const noexcept { return columns_; }
  [[nodiscard]] std::size_t rows() const noexcept { return rows_; }
  [[nodiscard]] const std::optional<Slice>& slice() const noexcept { return slice_; }

  /// Returns the claim of all boxes over a tile: singular if one is, else undecided if one is, else
  /// free if one is, else outside, else out of reach.
  [[nodiscard]] Claim claim(std::size_t column, std::size_t row) const noexcept;
  /// Returns the free part of the volume over a tile, in [0, 1], of what is neither outside nor out
  /// of reach; negative if nothing else is there.
  ///
  /// Requires  the options ask for shares.
  [[nodiscard]] double free_share(std::size_t column, std::size_t row) const noexcept;
  [[nodiscard]] const DeterminantTile& determinant(std::size_t column) const noexcept {
    return determinants_[column];
  }

  using TilePredicate = std::function<bool(std::size_t column, std::size_t row)>;
  /// Returns rectangles that cover the tiles that are wanted, each tile once.
  [[nodiscard]] std::vector<TileRectangle> rectangles(const TilePredicate& wanted) const;
  [[nodiscard]] std::vector<TileRectangle> rectangles(Claim claim) const;

 private:
  struct Span {
    std::size_t begin, end;
  };
  struct Volume {
    double free = 0, all = 0;
  };
  [[nodiscard]] Span tiles(std::size_t axis, std::size_t count, Interval x) const noexcept;
  [[nodiscard]] double part_of_tile(std::size_t axis, std::size_t count, std::size_t tile,
                                    Interval x) const noexcept;
  [[nodiscard]] bool meets_slice(std::span<const Interval> box) const noexcept;
  void paint(std::span<const Interval> box, Claim claim) noexcept;
  void add_volume(std::span<const Interval> box, Claim claim, Span across, Span up) noexcept;

  std::optional<LeafClaims> claims_;  ///< if boxes can be out of reach
  std::optional<Slice> slice_;
  std::vector<std::size_t> drawn_;
  std::vector<Interval> ranges_;     ///< of the axes that are drawn
  std::vector<std::size_t> hidden_;  ///< axes that are neither drawn nor cut
  std::size_t columns_, rows_;
  std::vector<std::uint8_t> tiles_;  ///< a bit for each kind of box that was over the tile
  std::vector<Volume> volumes_;      ///< empty unless shares are wanted
  std::vector<DeterminantTile> determinants_;
};

}  // namespace regulus::detail
