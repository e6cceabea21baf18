// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "runtime/cluster/unit.hpp"

namespace regulus::detail::cluster {

/// The place of a unit in the tree: the number of the first ancestor, then one byte for each group.
/// The order of these texts is the order of the units.
using Place = std::string;

/// Units that no worker has, in two orders: that of the tree, and the widest first.
class WaitingUnits {
 public:
  void insert(const Place& place, const Unit& unit);
  void erase(const Place& place);

  [[nodiscard]] bool empty() const noexcept { return widths_.empty(); }
  [[nodiscard]] std::size_t size() const noexcept { return widths_.size(); }

  /// Both remove the unit that they return.
  /// Requires  !empty().
  [[nodiscard]] Place take_first();
  [[nodiscard]] Place take_widest();

 private:
  std::map<Place, double> widths_;
  std::set<std::pair<double, Place>> by_width_;  ///< widths with a minus sign
};

/// Returns the part of the whole box that a unit has, roughly.
[[nodiscard]] double approx_width(const Unit& unit) noexcept;

}  // namespace regulus::detail::cluster
