// SPDX-License-Identifier: GPL-3.0-or-later
// Solutions that move while uncertain quantities are anywhere in a set: boxes are searched all over which
// the derivatives are regular, and a solution stays in those that can be reached from where it is.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "codegen/question/solve/root_search.hpp"

namespace regulus::detail {

/// Searches a box, and then what is undecided again, down to smaller parts, as long as it is little.
///
/// `search`: takes a box, and returns what it leaves undecided. It uses `settings`.
/// Returns   what is undecided at the end.
template <class Search>
[[nodiscard]] std::vector<std::vector<Interval>> search_in_levels(std::vector<Interval> box,
                                                                  RootSettings& settings,
                                                                  const Search& search) {
  // Parts of the ranges, and then of boxes, down to which these are split.
  constexpr double kFirstWidth = 0x1p-9, kNextWidth = 0x1p-3;
  constexpr int kLevels = 8;
  constexpr std::size_t kMostUndecided = 200;
  settings.min_relative_width = kFirstWidth;
  std::vector<std::vector<Interval>> undecided = search(std::move(box));
  settings.min_relative_width = kNextWidth;
  for (int level = 1; level < kLevels && undecided.size() <= kMostUndecided; ++level) {
    std::vector<std::vector<Interval>> next;
    while (!undecided.empty() && next.size() <= kMostUndecided) {
      const auto parts = search(std::exchange(undecided.back(), {}));
      undecided.pop_back();
      next.insert(next.end(), parts.begin(), parts.end());
    }
    next.insert(next.end(), undecided.begin(), undecided.end());
    undecided = std::move(next);
  }
  return undecided;
}

/// Returns what can be reached from a place through boxes that touch, with that place; nullopt: an open one, too.
template <class Place, class MayTouch>
[[nodiscard]] std::optional<std::vector<Place>> reach_from(const Place& start,
                                                           std::vector<Place> boxes,
                                                           const std::vector<Place>& open,
                                                           const MayTouch& may_touch) {
  std::vector<Place> reached = {start};
  for (std::size_t next = 0; next < reached.size(); ++next) {
    const auto touches = [&](const Place& box) { return may_touch(reached[next], box); };
    if (std::ranges::any_of(open, touches)) return std::nullopt;
    const auto near = std::partition(boxes.begin(), boxes.end(), std::not_fn(touches));
    // The insertion may move the box that `touches` refers to.
    std::vector<Place> found(near, boxes.end());
    boxes.erase(near, boxes.end());
    reached.insert(reached.end(), found.begin(), found.end());
  }
  return reached;
}

}  // namespace regulus::detail
