// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/page/box_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace regulus::inline page {
namespace {

/// A box of the tree, and the boxes that lie in it.
struct OpenPart {
  std::size_t id = 0;
  std::vector<Interval> box;
  std::vector<const ClaimedBox*> members;
  int depth = 0;
};

/// Far more than halvings of ranges need; a chain of slices would take hours.
constexpr int kMaxTreeDepth = 2000;

struct Cut {
  std::size_t variable = 0;
  double at = 0;
  double from_middle = 0;
};

bool is_equal(const std::vector<Interval>& a, const std::vector<Interval>& b) {
  return std::ranges::equal(
      a, b, [](const Interval& x, const Interval& y) { return x.lo == y.lo && x.hi == y.hi; });
}

/// Returns the cut along a variable that is nearest to the middle and crosses no box.
std::optional<Cut> cut_along(OpenPart& part, std::size_t variable) {
  const auto range = [variable](const ClaimedBox* box) { return box->box[variable]; };
  std::ranges::sort(part.members, {}, [&](const ClaimedBox* box) { return range(box).lo; });
  const Interval whole = part.box[variable];
  const double middle = whole.lo / 2 + whole.hi / 2;
  std::optional<Cut> best;
  double reached = whole.lo;
  for (const ClaimedBox* box : part.members) {
    const double at = range(box).lo;
    const double distance = std::abs(at - middle);
    if (at >= reached && whole.lo < at && at < whole.hi && (!best || distance < best->from_middle))
      best = {variable, at, distance};
    reached = std::max(reached, range(box).hi);
  }
  return best;
}

/// Prefers the most central cut, in parts of the box.
Cut choose_cut(OpenPart& part) {
  std::optional<Cut> best;
  double least = 0;
  for (std::size_t k = 0; k < part.box.size(); ++k) {
    const std::optional<Cut> cut = cut_along(part, k);
    if (!cut) continue;
    const double share = cut->from_middle / (part.box[k].hi - part.box[k].lo);
    if (best && !(share < least)) continue;
    best = cut;
    least = share;
  }
  if (!best) throw std::invalid_argument("they overlap, or are not made by splits");
  return *best;
}

std::pair<OpenPart, OpenPart> divided(OpenPart& part, const Cut& cut) {
  OpenPart lower{0, part.box, {}, part.depth + 1}, upper{0, part.box, {}, part.depth + 1};
  lower.box[cut.variable].hi = upper.box[cut.variable].lo = cut.at;
  for (const ClaimedBox* box : part.members)
    (box->box[cut.variable].hi <= cut.at ? lower : upper).members.push_back(box);
  return {std::move(lower), std::move(upper)};
}

}  // namespace

std::string tree_of_boxes(const std::vector<Interval>& root, const std::vector<ClaimedBox>& boxes) {
  std::vector<OpenPart> open{{0, root, {}, 0}};
  for (const ClaimedBox& box : boxes) open.back().members.push_back(&box);
  std::string lines;
  for (std::size_t next = 1; !open.empty();) {
    OpenPart part = std::move(open.back());
    open.pop_back();
    if (part.depth > kMaxTreeDepth) throw std::invalid_argument("they are not made by halvings");
    if (part.members.empty()) throw std::invalid_argument("they leave a gap");
    if (part.members.size() == 1) {
      if (!is_equal(part.members[0]->box, part.box))
        throw std::invalid_argument("they leave a gap");
      lines += fmt::format("l {} {}\n", part.id, part.members[0]->claim);
      continue;
    }
    const Cut cut = choose_cut(part);
    lines += fmt::format("s {} {} {}\n", part.id, cut.variable, cut.at);
    auto [lower, upper] = divided(part, cut);
    lower.id = next++;
    upper.id = next++;
    open.push_back(std::move(upper));
    open.push_back(std::move(lower));
  }
  return lines + fmt::format("end {}\n", boxes.size());
}

}  // namespace regulus::page
