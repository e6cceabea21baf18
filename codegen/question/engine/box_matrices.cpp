// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/box_matrices.hpp"

#include <algorithm>

namespace regulus::detail {

BoxMatrices::BoxMatrices(const Problem& problem, const MatrixScaling& scaling, std::size_t expanded)
    : problem_(problem),
      scaling_(scaling),
      kernel_(*problem.kernel),
      variables_(functions().variables),
      expanded_(expanded),
      columns_(functions().columns),
      entries_(std::size_t{functions().rows} * columns_),
      boxes_(2 * kLanes * variables_),
      center_boxes_(2 * kLanes * variables_),
      points_(2 * kLanes * variables_),
      center_values_(2 * kLanes * entries_),
      slopes_(2 * kLanes * entries_ * variables_),
      point_values_(2 * kLanes * entries_),
      constraints_(2 * kLanes * std::max(functions().constraints, 1U)) {}

/// It computes the same, equal to the bit.
void BoxMatrices::take_faster_kernel() {
  if (problem_.faster_kernel == nullptr) return;
  const regulus_kernel* faster = problem_.faster_kernel->load(std::memory_order_acquire);
  if (faster != nullptr && faster != &functions()) kernel_ = CheckedKernel(*faster);
}

void BoxMatrices::load(AlignedBuffer& to, std::size_t lane, std::span<const Interval> box) const {
  for (std::size_t v = 0; v < variables_; ++v) {
    to[lower_at(v, lane)] = box[v].lo;
    to[upper_at(v, lane)] = box[v].hi;
  }
}

LaneMask BoxMatrices::call(regulus_function function, const AlignedBuffer& boxes,
                           AlignedBuffer& out) const {
  return ~kernel_.call(function, boxes.get(), nullptr, out.get()) & kAllLanes;
}

bool BoxMatrices::has_constraints() const {
  return functions().constraint != nullptr && functions().constraints > 0;
}

/// The derivatives must be bounded between the centre and every pose of the box.
void BoxMatrices::evaluate(std::span<const Box> boxes) {
  take_faster_kernel();
  needs_slopes_ = has_slopes();
  boxes_given_.assign(boxes.begin(), boxes.end());
  centers_ = boxes_given_;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const std::size_t from = std::min(lane, boxes.size() - 1);
    Box joined = boxes[from];
    for (std::size_t v = 0; has_centers() && v < expanded_; ++v) {
      centers_[from][v] = center_of(boxes[from][v], v);
      joined[v] = hull(joined[v], centers_[from][v]);
    }
    load(boxes_, lane, joined);
    load(center_boxes_, lane, centers_[from]);
    load(points_, lane, nominal_point(centers_[from]));
  }
  outside_ = 0;
  if (has_constraints()) {
    const LaneMask defined = call(functions().constraint, boxes_, constraints_);
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      for (std::size_t h = 0; has_lane(defined, lane) && h < functions().constraints; ++h)
        if (constraints_[lower_at(h, lane)] > 0) outside_ |= LaneMask{1} << lane;
  }
  inside_ = certain_inside();
  center_defined_ = call(functions().matrix, center_boxes_, center_values_);
  slopes_defined_ = has_slopes() ? call(functions().matrix_derivatives, boxes_, slopes_) : 0;
  point_defined_ = call(functions().matrix, points_, point_values_);
}

void BoxMatrices::evaluate_entries(std::span<const Box> boxes, bool has_slopes) {
  take_faster_kernel();
  needs_slopes_ = has_slopes;
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    load(boxes_, lane, boxes[std::min(lane, boxes.size() - 1)]);
  outside_ = 0;
  center_defined_ = call(functions().matrix, boxes_, center_values_);
  slopes_defined_ = has_slopes ? call(functions().matrix_derivatives, boxes_, slopes_) : 0;
}

LaneMask BoxMatrices::certain_inside() {
  if (!has_constraints()) return kAllLanes;
  LaneMask lanes = call(functions().constraint, points_, constraints_);
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    for (std::size_t h = 0; h < functions().constraints; ++h)
      if (!(constraints_[upper_at(h, lane)] <= 0)) lanes &= ~(LaneMask{1} << lane);
  return lanes;
}

Interval BoxMatrices::center_of(const Interval& x, std::size_t variable) const {
  const std::optional<Interval>& inner = problem_.inner[variable];
  return inner ? Interval(std::clamp(mid(x), inner->lo, inner->hi)) : x;
}

BoxMatrices::Box BoxMatrices::nominal_point(const Box& center) const {
  Box point = center;
  for (std::size_t v = 0; v < variables_; ++v) {
    const std::optional<Interval>& inner = problem_.inner[v];
    if (inner) point[v] = v < expanded_ ? center_of(center[v], v) : Interval(mid(*inner));
  }
  return point;
}

BoxMatrices::Entries BoxMatrices::entries(const AlignedBuffer& values, std::size_t lane,
                                          std::size_t matrix) const {
  Entries result(entries_);
  for (std::size_t e = 0; e < entries_; ++e) {
    const std::size_t output = matrix * entries_ + e;
    result[e] = Interval(values[lower_at(output, lane)], values[upper_at(output, lane)]);
    if (!scaling_.empty())
      result[e] = times_power_of_two(
          result[e], -(scaling_.rows[e / columns_] + scaling_.columns[e % columns_]));
  }
  return result;
}

bool BoxMatrices::is_defined(std::size_t lane) const {
  return has_lane(center_defined_, lane) && (!needs_slopes_ || has_lane(slopes_defined_, lane));
}

bool BoxMatrices::is_inhabited(std::size_t lane) const {
  return has_lane(inside_, lane) && has_lane(point_defined_, lane);
}

BoxMatrix BoxMatrices::matrix(std::size_t lane) const {
  BoxMatrix matrix{entries(center_values_, lane, 0), {}, {}};
  if (!has_slopes()) return matrix;
  for (std::size_t k = 0; k < expanded_; ++k) {
    const Entries slope = entries(slopes_, lane, k);
    matrix.slopes.insert(matrix.slopes.end(), slope.begin(), slope.end());
  }
  matrix.radius = radius(lane);
  return matrix;
}

/// A centre that is not thin is all of the box: the only value of the variable is no double.
std::vector<double> BoxMatrices::radius(std::size_t lane) const {
  std::vector<double> radius;
  for (std::size_t k = 0; k < expanded_; ++k) {
    const Interval& center = centers_[lane][k];
    radius.push_back(is_thin(center) ? mag(boxes_given_[lane][k] - center) : 0);
  }
  return radius;
}

BoxMatrices::Entries BoxMatrices::matrix_at_point(std::size_t lane) const {
  return entries(point_values_, lane, 0);
}

std::vector<std::optional<BoxMatrices::Entries>> BoxMatrices::at(std::span<const Box> points) {
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    load(points_, lane, points[std::min(lane, points.size() - 1)]);
  inside_ = certain_inside();
  point_defined_ = call(functions().matrix, points_, point_values_);
  center_defined_ = slopes_defined_ = 0;
  std::vector<std::optional<Entries>> result(points.size());
  for (std::size_t lane = 0; lane < points.size(); ++lane)
    if (is_inhabited(lane)) result[lane] = matrix_at_point(lane);
  return result;
}

std::vector<Interval> BoxMatrices::pose_at(const Box& point) {
  if (functions().pose == nullptr) return {};
  const std::size_t count = functions().pose_parameters;
  AlignedBuffer values(2 * kLanes * std::max<std::size_t>(count, 1));
  for (std::size_t lane = 0; lane < kLanes; ++lane) load(points_, lane, point);
  static_cast<void>(call(functions().pose, points_, values));
  std::vector<Interval> pose;
  for (std::size_t q = 0; q < count; ++q)
    pose.emplace_back(values[lower_at(q, 0)], values[upper_at(q, 0)]);
  return pose;
}

}  // namespace regulus::detail
