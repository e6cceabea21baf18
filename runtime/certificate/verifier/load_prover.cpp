// SPDX-License-Identifier: Apache-2.0
#include "runtime/certificate/verifier/load_prover.hpp"

#include "runtime/certificate/verifier/leaf.hpp"

namespace regulus::verifier {
namespace {

constexpr int kMostPointsTried = 64;

LoadTest::Claim test_of(LeafClaim claim) {
  if (claim == LeafClaim::kInfeasible) return LoadTest::Claim::kNotHeld;
  return claim == LeafClaim::kOutside ? LoadTest::Claim::kOutside : LoadTest::Claim::kHeld;
}

}  // namespace

std::unique_ptr<Prover> make_prover(Question& question, const Variety& variety,
                                    const Options& options, WorkClock& clock) {
  if (question.load) return std::make_unique<LoadProver>(question, variety, options, clock);
  return std::make_unique<LeafProver>(question, variety, options, clock);
}

void LoadProver::begin(bool looks_for_points) {
  boxes_ = 0;
  has_met_variety_ = false;
  has_met_point_ = q_.constraints.empty() && q_.balls.empty();
  looks_for_points_ = looks_for_points;
  points_tried_ = 0;
}

void LoadProver::prove(const Box& box, LeafClaim claim) {
  const std::uint64_t before = boxes_;
  waiting_.assign(1, box);
  while (!waiting_.empty()) {
    const Box part = std::move(waiting_.back());
    waiting_.pop_back();
    ++boxes_;
    const auto give_up = [&](const std::string& why) {
      look_for_contradiction(part, test_of(claim));
      throw Unfinished(why);
    };
    if (boxes_ > options_.max_boxes || boxes_ - before > options_.max_boxes_per_leaf)
      give_up("not proved in " + std::to_string(boxes_ - before) + " smaller boxes");
    clock_.tick();
    if (claim == LeafClaim::kUndecided) {
      has_met_variety_ = true;
      continue;
    }
    const LoadTest::Answer answer = test_.decide(part, test_of(claim));
    if (answer == LoadTest::Answer::kOutside) continue;
    has_met_variety_ = true;
    if (!has_met_point_ && looks_for_points_) look_for_point();
    if (answer == LoadTest::Answer::kProved) continue;
    const auto k = test_.variable_to_split(part);
    if (boxes_ == before + 1) look_for_contradiction(part, test_of(claim));
    if (!k) give_up("not proved in a box that cannot be split any more");
    auto [lower, upper] = halves(part, *k);
    waiting_.push_back(std::move(upper));
    waiting_.push_back(std::move(lower));
  }
}

/// Tries the middles of the first boxes as points. A claim about no point at all has no value.
void LoadProver::look_for_point() {
  if (points_tried_++ < kMostPointsTried)
    has_met_point_ = is_certain_point(q_, variety_, test_.middle());
}

/// Shows that the claim is false at the middle of a box, and that this is a point of the variety.
void LoadProver::look_for_contradiction(const Box& box, LoadTest::Claim claim) {
  Middle middle;
  place_middle(variety_, box, middle);
  if (!is_certain_point(q_, variety_, middle.point)) return;
  if (claim == LoadTest::Claim::kOutside)
    throw Rejection("the middle of a part of it is in the variety");
  const bool is_held = claim == LoadTest::Claim::kHeld;
  const auto answer =
      test_.decide(middle.point, is_held ? LoadTest::Claim::kNotHeld : LoadTest::Claim::kHeld);
  if (answer == LoadTest::Answer::kProved)
    throw Rejection(is_held ? "at the middle of a part of it some wrench is held by no forces"
                            : "at the middle of a part of it every wrench is held");
}

}  // namespace regulus::verifier
