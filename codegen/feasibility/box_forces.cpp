// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/feasibility/box_forces.hpp"

#include <algorithm>

namespace regulus::inline feasibility {

BoxForces::BoxForces(const ForceQuestion& question)
    : question_(question),
      kernel_(*question.problem.kernel),
      variables_(kernel_.functions().variables),
      parameters_(kernel_.functions().motion_variables),
      entries_(question.forces.rows * question.forces.columns),
      test_(question.forces),
      boxes_(2 * kLanes * variables_),
      center_boxes_(2 * kLanes * variables_),
      points_(2 * kLanes * variables_),
      center_values_(2 * kLanes * entries_),
      slopes_(2 * kLanes * entries_ * variables_),
      point_values_(2 * kLanes * entries_),
      constraints_(2 * kLanes * std::max(kernel_.functions().constraints, 1U)) {}

std::vector<BoxOutcome> BoxForces::decide(std::span<const Box> boxes) {
  evaluate(boxes);
  std::vector<BoxOutcome> outcomes;
  for (std::size_t lane = 0; lane < boxes.size(); ++lane)
    outcomes.push_back(outcome(boxes[lane], lane));
  return outcomes;
}

void BoxForces::load(AlignedBuffer& to, std::size_t lane, std::span<const Interval> box) const {
  for (std::size_t v = 0; v < variables_; ++v) {
    to[lower_at(v, lane)] = box[v].lo;
    to[upper_at(v, lane)] = box[v].hi;
  }
}

LaneMask BoxForces::call(regulus_function function, const AlignedBuffer& boxes,
                         AlignedBuffer& out) const {
  return ~kernel_.call(function, boxes.get(), nullptr, out.get()) & kAllLanes;
}

/// The derivatives must be bounded between the centre and every pose of the box.
void BoxForces::evaluate(std::span<const Box> boxes) {
  const regulus_kernel& functions = kernel_.functions();
  centers_.assign(boxes.begin(), boxes.end());
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const std::size_t from = std::min(lane, boxes.size() - 1);
    Box joined = boxes[from];
    if (functions.matrix_derivatives != nullptr)
      for (std::size_t v = 0; v < parameters_; ++v) {
        centers_[from][v] = center_of(boxes[from][v], v);
        joined[v] = hull(joined[v], centers_[from][v]);
      }
    load(boxes_, lane, joined);
    load(center_boxes_, lane, centers_[from]);
    load(points_, lane, nominal_point(centers_[from]));
  }
  outside_ = 0;
  inside_ = kAllLanes;
  if (functions.constraint != nullptr && functions.constraints > 0) {
    const LaneMask defined = call(functions.constraint, boxes_, constraints_);
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      for (std::size_t h = 0; has_lane(defined, lane) && h < functions.constraints; ++h)
        if (constraints_[lower_at(h, lane)] > 0) outside_ |= LaneMask{1} << lane;
    inside_ = certain_inside(call(functions.constraint, points_, constraints_));
  }
  center_defined_ = call(functions.matrix, center_boxes_, center_values_);
  slopes_defined_ = call(functions.matrix_derivatives, boxes_, slopes_);
  point_defined_ = call(functions.matrix, points_, point_values_);
}

LaneMask BoxForces::certain_inside(LaneMask lanes) const {
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    for (std::size_t h = 0; h < kernel_.functions().constraints; ++h)
      if (!(constraints_[upper_at(h, lane)] <= 0)) lanes &= ~(LaneMask{1} << lane);
  return lanes;
}

Interval BoxForces::center_of(const Interval& x, std::size_t variable) const {
  const std::optional<Interval>& inner = question_.problem.inner[variable];
  return inner ? Interval(std::clamp(mid(x), inner->lo, inner->hi)) : x;
}

/// Uncertain quantities get the middles of their ranges.
BoxForces::Box BoxForces::nominal_point(const Box& center) const {
  Box point = center;
  for (std::size_t v = 0; v < variables_; ++v) {
    const std::optional<Interval>& inner = question_.problem.inner[v];
    if (inner) point[v] = v < parameters_ ? center_of(center[v], v) : Interval(mid(*inner));
  }
  return point;
}

std::vector<Interval> BoxForces::entries(const AlignedBuffer& values, std::size_t lane,
                                         std::size_t matrix) const {
  const std::size_t columns = question_.forces.columns;
  std::vector<Interval> result(entries_);
  for (std::size_t e = 0; e < entries_; ++e) {
    const std::size_t output = matrix * entries_ + e;
    result[e] = Interval(values[lower_at(output, lane)], values[upper_at(output, lane)]);
    if (!question_.scaling.empty())
      result[e] = times_power_of_two(result[e], -(question_.scaling.rows[e / columns] +
                                                  question_.scaling.columns[e % columns]));
  }
  return result;
}

BoxMatrix BoxForces::matrix_of(const Box& box, std::size_t lane) const {
  BoxMatrix matrix{entries(center_values_, lane, 0), {}, {}};
  if (kernel_.functions().matrix_derivatives == nullptr) return matrix;
  for (std::size_t k = 0; k < parameters_; ++k) {
    const std::vector<Interval> slope = entries(slopes_, lane, k);
    matrix.slopes.insert(matrix.slopes.end(), slope.begin(), slope.end());
    // A centre that is not thin is all of the box: the only value of the parameter is no double.
    const Interval& center = centers_[lane][k];
    matrix.radius.push_back(is_thin(center) ? mag(box[k] - center) : 0);
  }
  return matrix;
}

BoxOutcome BoxForces::outcome(const Box& box, std::size_t lane) {
  BoxOutcome result;
  if (has_lane(outside_, lane)) {
    result.kind = BoxOutcome::Kind::kOutside;
    return result;
  }
  result.is_inhabited = has_lane(inside_, lane) && has_lane(point_defined_, lane);
  const bool has_slopes = kernel_.functions().matrix_derivatives != nullptr;
  const bool is_defined =
      has_lane(center_defined_, lane) && (!has_slopes || has_lane(slopes_defined_, lane));
  result.is_undefined = !is_defined;
  ForceDecision decision;
  if (is_defined) decision = test_.decide(matrix_of(box, lane));
  using Kind = ForceDecision::Kind;
  if (decision.kind == Kind::kHeld) {
    result.kind = BoxOutcome::Kind::kHeld;
    return result;
  }
  look_at_center(lane, decision, result);
  if (decision.kind == Kind::kNotHeld) result.kind = BoxOutcome::Kind::kNotHeld;
  result.is_hopeless = is_defined && has_slopes && result.is_inhabited &&
                       decision.fails_at_center && !result.witness;
  result.impact = std::move(decision.impact);
  return result;
}

/// A box in which the load is not held has a witness only if one of its poses is certainly in the
/// variety.
void BoxForces::look_at_center(std::size_t lane, const ForceDecision& decision,
                               BoxOutcome& outcome) {
  if (!outcome.is_inhabited) return;
  const auto keep = [&](const ForceDecision& made) {
    if (made.shortage)
      outcome.witness.emplace(ForceWitness{nominal_point(centers_[lane]), *made.shortage});
  };
  keep(decision);
  if (!outcome.witness) keep(test_.decide({entries(point_values_, lane, 0), {}, {}}));
}

}  // namespace regulus::feasibility
