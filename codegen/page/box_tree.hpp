// SPDX-License-Identifier: GPL-3.0-or-later
// The tree of a paving that is known by its boxes alone.
#pragma once

#include <string>
#include <vector>

#include "runtime/interval/interval.hpp"

namespace regulus::inline page {

struct ClaimedBox {
  std::vector<Interval> box;
  std::string claim;
};

/// Returns the lines of a tree of splits whose leaves are these boxes, up to `end`, as
/// PavingTree::text().
///
/// Requires  every box has as many intervals as `root`.
/// Ensures   the boxes tile `root`. Throws std::invalid_argument otherwise, and for boxes that no
///           splits make.
[[nodiscard]] std::string tree_of_boxes(const std::vector<Interval>& root,
                                        const std::vector<ClaimedBox>& boxes);

}  // namespace regulus::page
