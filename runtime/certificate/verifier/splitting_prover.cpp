// SPDX-License-Identifier: Apache-2.0
#include "runtime/certificate/verifier/splitting_prover.hpp"

namespace regulus::verifier {
namespace {

constexpr int kMostMiddlesTried = 64;

}  // namespace

void SplittingProver::begin(bool looks_for_points) {
  boxes_ = 0;
  has_met_variety_ = false;
  has_met_point_ = q_.constraints.empty() && q_.balls.empty();
  looks_for_points_ = looks_for_points;
  points_tried_ = 0;
}

void SplittingProver::prove(const Box& box, LeafClaim claim) {
  const std::uint64_t before = boxes_;
  waiting_.assign(1, box);
  while (!waiting_.empty()) {
    const Box part = std::move(waiting_.back());
    waiting_.pop_back();
    ++boxes_;
    const auto give_up = [&](const std::string& why) {
      look_for_contradiction(part, claim);
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
    if (boxes_ == before + 1) look_for_contradiction(part, claim);
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
    throw Rejection(why);
}

}  // namespace regulus::verifier
