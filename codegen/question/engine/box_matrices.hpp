// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluates the matrix of a kernel, its derivatives and the constraints over eight boxes at once.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "codegen/kernel/formulation/scaling.hpp"
#include "runtime/interval/lanes.hpp"
#include "runtime/kernel/call.hpp"
#include "runtime/problem/problem.hpp"
#include "runtime/regularity/aligned_buffer.hpp"

namespace regulus::detail {

/// A over a box X × G: X of the expanded variables x, c a point of it, G of the other variables.
struct BoxMatrix {
  std::vector<Interval> center;  ///< encloses A(c) for every value of G, row-major
  std::vector<Interval> slopes;  ///< encloses ∂_kA over X × G, k by k; empty: `center` is A over X
  std::vector<double> radius;    ///< |x_k − c_k| is at most that, k by k; empty if there are none
};

/// Each thread has its own.
class BoxMatrices {
 public:
  using Box = std::vector<Interval>;
  using Entries = std::vector<Interval>;

  /// `expanded`: the number of variables, from the first, with a centre. `scaling`: of the kernel's
  /// matrix; the results are those of the model's. Both objects must outlive this one.
  BoxMatrices(const Problem& problem, const MatrixScaling& scaling, std::size_t expanded);

  /// Shape     boxes: 1…8 boxes, each with an interval for every variable of the kernel.
  /// Rounding  outward; MXCSR at nearest.
  void evaluate(std::span<const Box> boxes);

  /// Evaluates the matrix over the boxes, and perhaps its derivatives, and nothing else.
  ///
  /// Requires  no variable is expanded.
  void evaluate_entries(std::span<const Box> boxes, bool has_slopes);

  [[nodiscard]] bool has_constraints() const;

  // The functions below are about the boxes of the last evaluate(), by lane.

  /// True if some constraint excludes every pose of the box.
  [[nodiscard]] bool is_outside(std::size_t lane) const { return has_lane(outside_, lane); }
  /// True if the matrix is certainly defined all over the box, and has bounded slopes.
  [[nodiscard]] bool is_defined(std::size_t lane) const;
  /// True if the point of the box certainly meets the constraints, and the matrix is defined there.
  [[nodiscard]] bool is_inhabited(std::size_t lane) const;
  [[nodiscard]] bool has_slopes() const { return functions().matrix_derivatives != nullptr; }
  /// Returns the radius of each expanded variable about the centre.
  [[nodiscard]] std::vector<double> radius(std::size_t lane) const;
  /// The centres, and the boxes joined with them, as the kernel takes them.
  [[nodiscard]] const AlignedBuffer& center_lanes() const { return center_boxes_; }
  [[nodiscard]] const AlignedBuffer& box_lanes() const { return boxes_; }
  [[nodiscard]] const CheckedKernel& kernel() const { return kernel_; }
  /// Requires  is_defined(lane).
  [[nodiscard]] BoxMatrix matrix(std::size_t lane) const;
  /// Returns the derivatives of the entries by a variable, over the box.
  ///
  /// Requires  is_defined(lane), has_slopes().
  [[nodiscard]] Entries slope(std::size_t lane, std::size_t variable) const {
    return entries(slopes_, lane, variable);
  }
  /// Returns the centre, with the middles of the ranges of the variables that are not expanded.
  /// Each coordinate is within the true range: thin, or enclosing the only value.
  [[nodiscard]] Box point(std::size_t lane) const { return nominal_point(centers_[lane]); }
  /// Requires  is_inhabited(lane).
  [[nodiscard]] Entries matrix_at_point(std::size_t lane) const;

  /// Returns the matrix at each of 1…8 points; nullopt if it is not certainly defined, or if the
  /// point does not certainly meet the constraints. Forgets the boxes.
  [[nodiscard]] std::vector<std::optional<Entries>> at(std::span<const Box> points);
  /// Encloses the pose at a point; empty if the kernel does not compute it.
  [[nodiscard]] std::vector<Interval> pose_at(const Box& point);

 private:
  [[nodiscard]] const regulus_kernel& functions() const { return kernel_.functions(); }
  void take_faster_kernel();
  void load(AlignedBuffer& to, std::size_t lane, std::span<const Interval> box) const;
  /// Returns the lanes in which the function is defined.
  LaneMask call(regulus_function function, const AlignedBuffer& boxes, AlignedBuffer& out) const;
  /// Returns the lanes of `points_` that certainly meet the constraints.
  [[nodiscard]] LaneMask certain_inside();
  [[nodiscard]] bool has_centers() const {
    return has_slopes() || functions().expansion != nullptr;
  }
  [[nodiscard]] Interval center_of(const Interval& x, std::size_t variable) const;
  [[nodiscard]] Box nominal_point(const Box& center) const;
  [[nodiscard]] Entries entries(const AlignedBuffer& values, std::size_t lane,
                                std::size_t matrix) const;

  const Problem& problem_;
  const MatrixScaling& scaling_;
  CheckedKernel kernel_;
  const std::size_t variables_, expanded_, columns_, entries_;
  std::vector<Box> boxes_given_, centers_;
  AlignedBuffer boxes_, center_boxes_, points_;
  AlignedBuffer center_values_, slopes_, point_values_, constraints_;
  bool needs_slopes_ = true;
  LaneMask center_defined_ = 0, slopes_defined_ = 0, point_defined_ = 0, outside_ = 0, inside_ = 0;
};

}  // namespace regulus::detail
