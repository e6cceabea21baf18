// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/splitting_prover.hpp"

#include <algorithm>

namespace regulus::verifier {
namespace {

constexpr int kMostMiddlesTried = 64;
/// Beyond so many variables, some share the side of a corner.
constexpr std::size_t kMostCornerBits = 10;
/// A leaf that takes more is often false.
constexpr std::uint64_t kBoxesOfDoubt = 256;

}  // namespace

void SplittingProver::begin(bool looks_for_points) {
  boxes_ = 0;
  has_met_variety_ = false;
  has_met_point_ = q_.constraints.empty() && q_.balls.empty();
  looks_for_points_ = looks_for_points;
  points_tried_ = 0;
}

void SplittingProver::prove(const Leaf& leaf) {
  const Box& box = leaf.box;
  const LeafClaim claim = leaf.claim;
  const std::uint64_t before = boxes_;
  std::uint64_t boxes_at_next_look = 1;
  bool has_doubt = false;
  waiting_.assign(1, box);
  while (!waiting_.empty()) {
    const Box part = std::move(waiting_.back());
    waiting_.pop_back();
    ++boxes_;
    const auto give_up = [&](const std::string& why) {
      look_for_contradiction(part, claim);
      look_at_corners(box, claim);
      throw Unfinished(why);
    };
    if (boxes_ > options_.max_boxes || boxes_ - before > options_.max_boxes_per_leaf)
      give_up("not proved in " + std::to_string(boxes_ - before) + " smaller boxes");
    clock_.tick();
    if (claim == LeafClaim::kUndecided) {
      has_met_variety_ = true;
      continue;
    }
    const BoxAnswer answer = decide(part, claim);
    if (answer == BoxAnswer::kOutside) continue;
    has_met_variety_ = true;
    if (!has_met_point_ && looks_for_points_) look_for_point(part);
    if (answer == BoxAnswer::kProved) continue;
    const auto k = variable_to_split(part);
    const std::uint64_t boxes_of_leaf = boxes_ - before;
    if (boxes_of_leaf >= boxes_at_next_look) {
      look_for_contradiction(part, claim);
      boxes_at_next_look = 2 * boxes_of_leaf;
    }
    if (boxes_of_leaf >= kBoxesOfDoubt && !has_doubt) {
      has_doubt = true;
      look_at_corners(box, claim);
    }
    if (!k) give_up("not proved in a box that cannot be split any more");
    auto [lower, upper] = halves(part, *k);
    waiting_.push_back(std::move(upper));
    waiting_.push_back(std::move(lower));
  }
}

/// Tries the middles of the first boxes as points. A claim about no point at all has no value.
void SplittingProver::look_for_point(const Box& box) {
  if (points_tried_++ >= kMostMiddlesTried) return;
  Middle middle;
  place_middle(variety_, box, middle);
  has_met_point_ = is_certain_point(q_, variety_, middle.point);
}

/// Shows that the claim is false at the middle of a box, and that this is a point of the variety.
void SplittingProver::look_for_contradiction(const Box& box, LeafClaim claim) {
  Middle middle;
  place_middle(variety_, box, middle);
  if (!is_certain_point(q_, variety_, middle.point)) return;
  if (const std::string why = contradiction(middle.point, claim); !why.empty())
    throw Rejection("at the middle of a part of it " + why);
}

/// The same at corners of a leaf, where extreme values often are.
void SplittingProver::look_at_corners(const Box& leaf, LeafClaim claim) {
  const std::size_t bits = std::min(leaf.size(), kMostCornerBits);
  for (std::size_t corner = 0; corner >> bits == 0; ++corner) {
    Box point = leaf;
    bool is_inside = true;
    for (std::size_t k = 0; k < leaf.size(); ++k)
      if (const auto& inner = variety_.inner[k]) {
        const bool upper = ((corner >> (k % bits)) & 1) != 0;
        const double x = std::clamp(upper ? leaf[k].hi : leaf[k].lo, inner->lo, inner->hi);
        is_inside = is_inside && contains(leaf[k], x);
        point[k] = verifier::point(x);
      }
    if (!is_inside) continue;
    if (!is_certain_point(q_, variety_, point)) continue;
    if (const std::string why = contradiction(point, claim); !why.empty())
      throw Rejection("at a corner of it " + why);
  }
}

}  // namespace regulus::verifier
