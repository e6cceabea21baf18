// SPDX-License-Identifier: Apache-2.0
// Up to eight boxes and what has been computed about them. Each quantity is computed for all lanes
// when it is first asked for, so that a test pays only for what it needs. No allocation after
// construction.
#pragma once

#include <optional>
#include <span>

#include "regulus/kernel/call.hpp"
#include "regulus/regularity/aligned_buffer.hpp"
#include "regulus/regularity/determinant.hpp"
#include "regulus/regularity/lanes.hpp"
#include "regulus/regularity/second_order.hpp"
#include "regulus/search/problem.hpp"

namespace regulus {

class Batch {
 public:
  Batch(const Problem& problem, const Settings& settings, const RowStructure& structure);

  /// Forgets everything. Then load 1…8 lanes from 0, without gaps, and seal.
  void clear() noexcept;
  void load(std::size_t lane, std::span<const Interval> box) noexcept;
  /// Loads copies of lane 0 into the lanes before `count`, of which single ranges may then change.
  void spread(std::size_t count) noexcept;
  void change(std::size_t lane, std::size_t variable, Interval x) noexcept {
    load_variable(variable, lane, x);
  }
  /// Fills the lanes from `count` on with copies of lane 0: kernels want eight proper boxes.
  void seal(std::size_t count) noexcept;

  [[nodiscard]] LaneMask loaded() const noexcept { return loaded_; }
  [[nodiscard]] Interval box(std::size_t variable, std::size_t lane) const noexcept {
    return {boxes_[lower_at(variable, lane)], boxes_[upper_at(variable, lane)]};
  }
  /// All of them, interval layout.
  [[nodiscard]] const double* boxes() const noexcept { return boxes_.get(); }
  [[nodiscard]] double midpoint(std::size_t variable, std::size_t lane) const noexcept {
    return midpoint_[point_at(variable, lane)];
  }
  [[nodiscard]] double radius(std::size_t variable, std::size_t lane) const noexcept {
    return radius_[point_at(variable, lane)];
  }

  // Over the boxes. Masks speak of all points of a box.

  /// Some constraint is certainly positive.
  [[nodiscard]] LaneMask certain_outside() noexcept;
  /// Every constraint is certainly ≤ 0.
  [[nodiscard]] LaneMask certain_inside() noexcept;
  /// The row scales are defined and positive, and the pose is defined.
  [[nodiscard]] LaneMask certain_posed() noexcept;
  /// Encloses the product of the row scales.
  [[nodiscard]] Interval row_scale(std::size_t lane) noexcept;
  /// Of all lanes, one entry, interval layout.
  [[nodiscard]] const double* row_scales() noexcept;
  /// K·A, A·K or A in interval layout; lanes that are not defined are taken out of `lanes`.
  [[nodiscard]] const double* product(ProductForm form, LaneMask& lanes) noexcept;
  /// Encloses det A (`scaled`: det J⁻¹) over a box of a square kernel; nullopt if it is not
  /// certainly defined there.
  [[nodiscard]] std::optional<Interval> determinant(std::size_t lane, bool scaled) noexcept;
  /// Whether |det J⁻¹| > α follows from |det A| ≥ lower.
  [[nodiscard]] bool certain_above_threshold(std::size_t lane, double lower) noexcept;

  // The determinant in closed form: one entry, interval layout; [−∞, ∞] in lanes without.

  /// From the kernel's `determinant` over the boxes.
  [[nodiscard]] const double* natural_determinant() noexcept;
  /// The same, narrowed by the signs and the magnitudes of the derivatives.
  ///
  /// Requires  the kernel has them.
  [[nodiscard]] const double* monotone_determinant() noexcept;

  // At the midpoints.

  /// A is defined at the midpoint.
  [[nodiscard]] LaneMask midpoint_defined() noexcept;
  /// A is defined at the midpoint and K was found.
  [[nodiscard]] LaneMask preconditioned() noexcept;
  /// K, n×m, point layout.
  [[nodiscard]] const double* preconditioner() noexcept;
  /// There is no K, or K·A is so far from the identity even at the midpoint that tests on K·A fail
  /// for boxes of any size: A is too close to a singular matrix for the digits that K has.
  [[nodiscard]] LaneMask poorly_preconditioned() noexcept;
  [[nodiscard]] Interval preconditioner_determinant(std::size_t lane) noexcept;
  /// det A to nearest.
  [[nodiscard]] double approx_determinant(std::size_t lane) noexcept;
  [[nodiscard]] double approx_row_scale(std::size_t lane) noexcept;
  /// Every constraint is certainly ≤ 0 at the midpoint.
  [[nodiscard]] LaneMask midpoint_inside() noexcept;
  /// Some constraint is certainly positive at the midpoint.
  [[nodiscard]] LaneMask midpoint_outside() noexcept;

  // For the H-matrix test and for bisection.

  /// P ≥ |KA − I| from natural entries; +∞ in lanes without.
  [[nodiscard]] double* natural_bounds() noexcept;
  /// The same, lowered to the mean-value bound where that is smaller.
  [[nodiscard]] double* mean_value_bounds() noexcept;
  /// T of regulus/regularity/second_order.hpp, of order order(); +∞ in lanes without.
  [[nodiscard]] double* second_order_bounds() noexcept;
  [[nodiscard]] std::size_t order() const noexcept { return columns_ + structure_.rows.size(); }
  /// Upper bounds of |det K(t)|/|det K| for the preconditioner that belongs to T.
  void moving_determinant_ru(double* upper) noexcept;
  /// Perron vector and spectral radius of T, or of P where there is no T; roughly.
  [[nodiscard]] double approx_spectral_radius(std::size_t lane) noexcept;
  /// SecondOrderBounds::certain_by_orthants on T.
  [[nodiscard]] LaneMask certain_by_orthants(LaneMask lanes) noexcept;
  /// Where a test computes its v; keep_vector then saves those that proved something.
  [[nodiscard]] double* candidate_vector() noexcept { return candidate_vector_.get(); }
  void keep_vector(LaneMask lanes, std::size_t entries) noexcept;
  /// v of the test that certified a lane.
  [[nodiscard]] const double* vector() const noexcept { return vector_.get(); }
  /// What each variable adds to the spectral radius of T or, without it, of |NM − I|, where M is
  /// the matrix the method looks at and N inverts its middle: K for A itself, I for a product with
  /// K; for the method closed-form what it adds to the width of the determinant. Roughly; point
  /// layout.
  [[nodiscard]] const double* approx_impact() noexcept;

  /// Declares that the box of this batch contains all boxes to come, and agrees with them in the
  /// variables that may not be split: what holds on all of it need not be asked again, and those
  /// variables need not be loaded again.
  ///
  /// Requires  that box is in every lane.
  void learn_from_root() noexcept;

  /// Calls a function of the kernel on the boxes.
  [[nodiscard]] LaneMask call_on_boxes(regulus_function function, double* out) noexcept {
    return call(function, boxes_.get(), nullptr, out);
  }
  [[nodiscard]] const regulus_kernel& kernel() const noexcept { return kernel_; }

 private:
  enum Stage : unsigned {
    kConstraints = 1U << 0,
    kPosed = 1U << 1,
    kMatrix = 1U << 2,
    kLeft = 1U << 3,
    kRight = 1U << 4,
    kLeftNumeric = 1U << 5,
    kRightNumeric = 1U << 6,
    kMidpoint = 1U << 7,
    kMidpointConstraints = 1U << 8,
    kNatural = 1U << 9,
    kMeanValue = 1U << 10,
    kImpact = 1U << 11,
    kDerivatives = 1U << 12,
    kMidpointScale = 1U << 13,
    kSecondOrder = 1U << 14,
    kDeterminant = 1U << 15,
    kDeterminantDerivatives = 1U << 16,
    kMonotone = 1U << 17,
    kSharpened = 1U << 18,
    kPerron = 1U << 19,
  };
  void load_variable(std::size_t variable, std::size_t lane, Interval x) noexcept;
  void copy_first_lane(std::size_t from) noexcept;
  [[nodiscard]] bool begin(Stage stage) noexcept;
  LaneMask call(regulus_function function, const double* boxes, const double* points,
                double* out) noexcept;
  void constraints_on(const double* boxes, LaneMask& inside, LaneMask& outside) noexcept;
  void compute_posed() noexcept;
  void compute_midpoint() noexcept;
  void compute_derivatives() noexcept;
  [[nodiscard]] LaneMask derivatives_of_product() noexcept;
  void multiply_left(const double* matrix, const double* K, double* out) const noexcept;
  void multiply_right(const double* matrix, const double* K, double* out) const noexcept;
  LaneMask product_on(const double* boxes, const double* K, double* out) noexcept;
  double* computed_product(ProductForm form, LaneMask& lanes) noexcept;
  void sharpen(double* entries, LaneMask lanes) noexcept;
  void intersect_with_mean_value(double* entries, LaneMask lanes) noexcept;
  void intersect_with_faces(double* entries, LaneMask lanes) noexcept;
  friend class FaceEvaluation;
  void compute_determinant_derivatives() noexcept;
  void load_face(bool least) noexcept;
  void narrow_on_face(bool least) noexcept;
  void compute_perron() noexcept;
  void impact_on_determinant() noexcept;
  void load_expansion_point() noexcept;
  [[nodiscard]] SecondOrderInput second_order_input() noexcept;
  [[nodiscard]] LaneMask call_listed(const regulus_derivatives& derivatives, const double* boxes,
                                     double* out) noexcept;
  void impact_from_derivatives() noexcept;
  void clear_impact(LaneMask lanes) noexcept;
  void impact_from_fixing() noexcept;
  void approx_distances(double* P) noexcept;
  void weigh_rows() noexcept;
  void weigh_impact(std::size_t variable, std::size_t row, std::size_t column,
                    const double* magnitude) noexcept;

  const Kernel caller_;
  const regulus_kernel& kernel_;
  const Interval alpha_;
  const std::size_t variables_, rows_, columns_;
  const std::size_t splittable_;  ///< the variables 0 … splittable_ − 1 may be split
  std::size_t changing_;  ///< the variables 0 … changing_ − 1 differ from batch to batch
  const RowStructure& structure_;
  const ProductForm form_;       ///< what the method looks at
  const bool sharpens_;          ///< the entries of that, by their derivatives
  const bool sees_mean_values_;  ///< the method uses them and the kernel has derivatives
  const bool sees_determinant_;  ///< the method uses its closed form
  bool posed_everywhere_ = false;
  bool expansion_point_known_ = false;
  LaneMask outside_contract_ = 0;  ///< of the kernel
  LaneMask fixed_outside_contract_ = 0, expansion_outside_contract_ = 0;
  unsigned done_ = 0;
  LaneMask loaded_ = 0;

  AlignedBuffer boxes_, thin_, thinned_, midpoint_, radius_;
  AlignedBuffer matrix_, midpoint_matrix_, approx_matrix_, preconditioner_;
  AlignedBuffer left_, right_, left_numeric_, right_numeric_, derivatives_;
  std::optional<SecondOrderBounds> second_order_;
  AlignedBuffer expanded_, expanded_radius_, center_product_;
  AlignedBuffer first_, second_, row_first_, row_second_, second_order_bounds_;
  AlignedBuffer bounds_, center_, vector_, candidate_vector_, right_perron_, left_perron_;
  AlignedBuffer face_boxes_, face_points_, face_entries_, matrix_derivatives_;
  AlignedBuffer impact_, scratch_;
  AlignedBuffer determinant_, monotone_, determinant_slopes_, face_, face_center_;
  double approx_spectral_radius_[kLanes] = {};
  OrthantCell orthant_hint_{};
  double approx_determinant_[kLanes] = {};
  double approx_scale_[kLanes] = {};
  alignas(64) double scale_[2 * kLanes] = {};
  LaneMask inside_ = 0, outside_ = 0, midpoint_inside_ = 0, midpoint_outside_ = 0;
  LaneMask posed_ = 0, matrix_defined_ = 0, left_defined_ = 0, right_defined_ = 0;
  LaneMask midpoint_defined_ = 0, preconditioned_ = 0, derivatives_defined_ = 0;
  LaneMask determinant_slopes_defined_ = 0, second_order_defined_ = 0;
};

}  // namespace regulus
