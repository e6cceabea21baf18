// SPDX-License-Identifier: GPL-3.0-or-later
// The source of a picture: a raster over one or two ranges. Each box is painted on it at once, so
// memory does not grow with their number. For drawing only, without a claim.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "codegen/report/paving_options.hpp"
#include "runtime/search/leaf_claims.hpp"

namespace regulus::inline report {

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
  Canvas(const PreparedSearch& preparation, const PavingOptions& options);

  void on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept override;
  void on_open(const OpenBox& box) noexcept override;

  [[nodiscard]] bool is_flat() const noexcept { return rows_ == 1; }
  [[nodiscard]] std::size_t columns() const noexcept { return columns_; }
  [[nodiscard]] std::size_t rows() const noexcept { return rows_; }

  /// Returns the claim of all boxes over a tile: singular if one is, else undecided if one is, else
  /// free if one is, else outside, else out of reach.
  [[nodiscard]] Claim claim(std::size_t column, std::size_t row) const noexcept;
  [[nodiscard]] const DeterminantTile& determinant(std::size_t column) const noexcept {
    return determinants_[column];
  }
  /// Returns rectangles that cover the tiles of a kind, each tile once.
  [[nodiscard]] std::vector<TileRectangle> rectangles(Claim claim) const;

 private:
  struct Span {
    std::size_t begin, end;
  };
  [[nodiscard]] Span tiles(std::size_t axis, std::size_t count, Interval x) const noexcept;
  void paint(std::span<const Interval> box, Claim claim) noexcept;

  std::optional<LeafClaims> claims_;  ///< if boxes can be out of reach
  std::vector<std::size_t> drawn_;
  std::vector<Interval> ranges_;
  std::size_t columns_, rows_;
  std::vector<std::uint8_t> tiles_;  ///< a bit for each kind of box that was over the tile
  std::vector<DeterminantTile> determinants_;
};

}  // namespace regulus::report
