// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/leaf.hpp"

#include <algorithm>

#include "runtime/verifier/linear_algebra.hpp"

namespace regulus::verifier {
namespace {

constexpr long kFirstBits = 64;
/// Exact algebra begins after this many boxes of a leaf.
constexpr std::uint64_t kBoxesBeforeAlgebra = 64;
/// For a matrix of at most this order it is tried at once, until so many boxes were too much for it.
constexpr std::size_t kSmallOrder = 3;
constexpr int kMostUselessAlgebra = 4;
constexpr int kMostPointsTried = 64;
constexpr std::size_t kProbeBits = 7, kProbes = 1 << kProbeBits;

}  // namespace

std::optional<PointValues> values_over(const Question& q, const Box& box, long bits) {
  std::vector<Ball> variables;
  for (const Interval x : box) variables.emplace_back(x, bits);
  std::vector<NodeId> roots = q.matrix;
  const std::vector<NodeId> kNone;
  for (const auto* list :
       {&q.constraints, q.has_threshold ? &q.scale : &kNone, &q.defined, &q.motion_defined})
    roots.insert(roots.end(), list->begin(), list->end());
  const auto values = evaluate(q.graph, roots, variables, bits);
  if (!values) return std::nullopt;

  PointValues result;
  auto next = values->begin();
  result.matrix.assign(next, next + std::ptrdiff_t(q.matrix.size()));
  next += std::ptrdiff_t(q.matrix.size());
  result.constraints.assign(next, next + std::ptrdiff_t(q.constraints.size()));
  next += std::ptrdiff_t(q.constraints.size());
  if (q.rows == q.columns) result.determinant = determinant(result.matrix, q.columns, bits);
  for (std::size_t i = 0; q.has_threshold && i < q.scale.size(); ++i, ++next)
    arb_mul(result.determinant.get(), result.determinant.get(), next->get(), bits);
  return result;
}

LeafProver::LeafProver(Question& question, const Variety& variety, const Options& options,
                       WorkClock& clock)
    : q_(question), variety_(variety), options_(options), clock_(clock), test_(question, variety) {
  begin(true);
}

void LeafProver::begin(bool looks_for_points) {
  boxes_ = 0;
  uses_algebra_ = has_met_variety_ = false;
  useless_algebra_ = 0;
  has_met_point_ = q_.constraints.empty() && q_.balls.empty();
  looks_for_points_ = looks_for_points;
  points_tried_ = sign_ = 0;
}

void LeafProver::prove(const Leaf& leaf) {
  const Box& box = leaf.box;
  const std::uint64_t before = boxes_;
  waiting_.assign(1, box);
  while (!waiting_.empty()) {
    const Box part = std::move(waiting_.back());
    waiting_.pop_back();
    ++boxes_;
    if (boxes_ > options_.max_boxes || boxes_ - before > options_.max_boxes_per_leaf)
      give_up(box, "not proved in " + std::to_string(boxes_ - before) + " smaller boxes");
    clock_.tick();
    const auto answer = test_.decide(part);
    if (answer == RegularityTest::Answer::kOutside) continue;
    has_met_variety_ = true;
    if (!has_met_point_ && looks_for_points_) look_for_point();
    if (answer == RegularityTest::Answer::kOpen || boxes_ == before + 1) look_for_contradiction();
    if (answer == RegularityTest::Answer::kRegular) continue;
    if (is_regular_exactly(part, boxes_ - before)) continue;
    if (const auto k = test_.variable_to_split(part)) {
      auto [lower, upper] = halves(part, *k);
      waiting_.push_back(std::move(upper));
      waiting_.push_back(std::move(lower));
    } else if (!proved_with_more_bits(part)) {
      give_up(box, "not proved in a box that cannot be split any more");
    }
  }
}

/// Shows that determinants, multiplied out, are not 0 anywhere in a box.
bool LeafProver::is_regular_exactly(const Box& box, std::uint64_t boxes_of_leaf) {
  if (!test_.is_defined() || is_exact_too_large_) return false;
  const bool is_cheap = q_.columns <= kSmallOrder && useless_algebra_ < kMostUselessAlgebra;
  if (!uses_algebra_ && !is_cheap && boxes_of_leaf < kBoxesBeforeAlgebra &&
      test_.variable_to_split(box))
    return false;
  try {
    const bool is_proved = is_proved_by_algebra(box);
    // The box is halved otherwise, and mostly the other tests prove the halves.
    useless_algebra_ += !is_proved;
    uses_algebra_ = uses_algebra_ || is_proved || !is_cheap;
    return is_proved;
  } catch (const Unfinished&) {
    // Too many operations in the forms or their derivatives; the other tests continue.
    is_exact_too_large_ = true;
    return false;
  }
}

bool LeafProver::is_proved_by_algebra(const Box& box) {
  if (q_.rows == q_.columns) {
    if (!exact_) exact_.emplace(q_, variety_, options_.max_bits);
    return exact_->exceeds_threshold(box);
  }
  if (!exact_rank_) exact_rank_.emplace(q_, variety_, options_.max_bits);
  return exact_rank_->is_full(box, test_.middle());
}

/// Tries the middles of the first boxes as points. A claim about no point at all has no value.
void LeafProver::look_for_point() {
  if (points_tried_++ >= kMostPointsTried) return;
  has_met_point_ = is_certain_point(q_, variety_, test_.middle());
}

/// First looks at some more points of the leaf. Next to a singularity, all points on one side of it
/// have the same sign.
void LeafProver::give_up(const Box& box, const std::string& why) {
  for (std::size_t probe = 0; probe < kProbes; ++probe) {
    Box corner = box;
    for (std::size_t k = 0; k < box.size(); ++k) {
      const bool upper = ((probe >> (k % kProbeBits)) & 1) != 0;
      if (variety_.inner[k])
        corner[k] = point(mid({upper ? mid(box[k]) : box[k].lo, upper ? box[k].hi : mid(box[k])}));
    }
    (void)test_.decide(corner);
    look_for_contradiction();
  }
  throw Unfinished(why);
}

/// Two points of opposite signs refute the claim, since a variety without constraints is convex: on
/// the segment between them, the matrix is singular or undefined somewhere.
void LeafProver::look_for_contradiction() {
  if (q_.has_threshold && q_.rows == q_.columns && certain_at_middle())
    throw Rejection("|det| is at most alpha at the middle of a part of it");
  if (!q_.constraints.empty()) return;
  const int sign = test_.sign_at_middle();
  if (sign == 0 || !certain_inside(q_, variety_, test_.middle())) return;
  if (sign_ * sign < 0)
    throw Rejection(
        "the determinant has opposite signs at two points of the variety, one of them in it");
  sign_ = sign;
}

/// Shows that |det J⁻¹| ≤ α at the middle of a box, and that it is a point of the variety.
bool LeafProver::certain_at_middle() const {
  const auto values = values_over(q_, test_.middle(), kFirstBits);
  if (!values || !(mag(values->determinant.enclosure()) <= variety_.alpha.lo)) return false;
  for (const Ball& h : values->constraints)
    if (!arb_is_nonpositive(h.get())) return false;
  return certain_inside(q_, variety_, test_.middle());
}

bool LeafProver::proved_with_more_bits(const Box& box) const {
  const bool is_square = q_.rows == q_.columns;
  for (long bits = kFirstBits; bits <= options_.max_bits; bits *= 2) {
    const auto values = values_over(q_, box, bits);
    if (!values) continue;
    if (is_square
            ? mig(values->determinant.enclosure()) > variety_.alpha.hi
            : independent_rows(values->matrix, q_.rows, q_.columns, bits).size() == q_.columns)
      return true;
  }
  return false;
}

}  // namespace regulus::verifier
