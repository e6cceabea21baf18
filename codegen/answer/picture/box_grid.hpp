// SPDX-License-Identifier: GPL-3.0-or-later
// The boxes of a paving over three ranges as an unstructured grid of VTK, for programs that show
// volumes.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "codegen/answer/picture/picture_options.hpp"
#include "runtime/search/leaf_claims.hpp"

namespace regulus::detail {

class BoxGrid final : public Observer {
 public:
  /// Requires  the paving has three ranges.
  BoxGrid(const PreparedSearch& preparation, const PictureOptions& options);

  void on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept override;
  void on_open(const OpenBox& box) noexcept override;

  /// Returns the text of a file in VTK's XML format: a hexahedron for each box, its `claim` as
  /// data, 0 free, 1 singular, 2 undecided, 3 outside, 4 out of reach. Coordinates are in the units
  /// of the model.
  [[nodiscard]] std::string text() const;

 private:
  struct Cell {
    std::array<Interval, 3> sides;
    Claim claim;
  };
  void add(std::span<const Interval> box, Claim claim) noexcept;
  [[nodiscard]] std::string array(const char* type, const char* name, int components,
                                  const std::string& numbers) const;

  std::optional<LeafClaims> claims_;  ///< if boxes can be out of reach
  std::vector<std::size_t> axes_;
  std::string description_, words_;
  std::vector<Cell> cells_;
  bool is_full_ = false;  ///< memory ran out
};

}  // namespace regulus::detail
