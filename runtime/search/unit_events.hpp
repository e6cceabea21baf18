// SPDX-License-Identifier: Apache-2.0
// Splits, leaves and open boxes of a unit as bytes: in preorder, about one byte a box.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/cluster/bytes.hpp"
#include "runtime/evaluation/decisions.hpp"

namespace regulus::detail {

/// The tree of splits below the boxes of a unit, while they are decided.
class UnitTree {
 public:
  explicit UnitTree(const Settings& settings) noexcept : settings_(settings) {}

  /// Forgets everything. Then the boxes 0 … roots − 1 are open.
  void begin(std::size_t roots);
  void set_leaf(BoxId box, const Decision& decision);
  /// Returns the number of the lower half; the upper half has the next one.
  [[nodiscard]] BoxId split(BoxId box, std::uint32_t variable);
  [[nodiscard]] std::size_t size() const noexcept { return nodes_.size(); }

  /// Returns the events, and appends the open boxes to `open`, both in preorder.
  [[nodiscard]] std::string events(std::size_t roots, std::vector<BoxId>& open) const;

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  struct Node {
    std::uint32_t code = 0;
    std::uint32_t next = kNone;  ///< the lower half, or the place of the details of a leaf
  };

  const Settings& settings_;
  std::vector<Node> nodes_;
  std::vector<std::string> details_;
};

/// One event of the search: a split, a leaf, or a box that stays open.
struct UnitEvent {
  enum class Kind : std::uint8_t { kOpen, kLeaf, kSplit };
  Kind kind = Kind::kOpen;
  Decision decision;  ///< if it is a leaf: all of it; if it was split: the variable
};

/// Returns the next of the events that UnitTree::events wrote with these settings. Throws
/// cluster::MalformedMessage.
[[nodiscard]] UnitEvent take_event(cluster::ByteReader& from, const Settings& settings);

}  // namespace regulus::detail
