// SPDX-License-Identifier: Apache-2.0
#include "regulus/search/batch.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "regulus/regularity/midpoint_inverse.hpp"

namespace regulus {
namespace {

LaneMask lanes_within(const double* x, std::size_t entries, double limit) noexcept {
  LaneMask within = kAllLanes;
  for (std::size_t e = 0; e < entries; ++e)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      within &= ~(static_cast<LaneMask>(!(std::fabs(x[point_at(e, lane)]) <= limit)) << lane);
  return within;
}

void clear_lane(double* x, std::size_t entries, std::size_t lane) noexcept {
  for (std::size_t e = 0; e < entries; ++e) x[point_at(e, lane)] = 0.0;
}

void midpoints_of(const double* intervals, std::size_t entries, double* points) noexcept {
  for (std::size_t e = 0; e < entries; ++e)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      points[point_at(e, lane)] =
          0.5 * intervals[lower_at(e, lane)] + 0.5 * intervals[upper_at(e, lane)];
}

/// Left products have their own derivatives; the others get theirs from those of A.
bool knows_derivatives(const regulus_kernel& kernel, ProductForm form) noexcept {
  if (form == ProductForm{ProductForm::Side::kLeft, false} && kernel.left_product != nullptr)
    return kernel.left_derivatives != nullptr;
  return kernel.matrix_derivatives != nullptr;
}

std::vector<DerivativePlace> places(const regulus_derivatives& derivatives) {
  std::vector<DerivativePlace> list;
  for (unsigned i = 0; i < derivatives.count; ++i) {
    const regulus_derivative& d = derivatives.list[i];
    list.push_back({d.row, d.column, d.first, d.second});
  }
  return list;
}

DerivativeLists listed_derivatives(const regulus_kernel& kernel) {
  const regulus_expansion& x = *kernel.expansion;
  return {kernel.rows,      kernel.columns,      kernel.variables,    places(x.first),
          places(x.second), places(x.row_first), places(x.row_second)};
}

}  // namespace

Batch::Batch(const Problem& problem, const Settings& settings, const RowStructure& structure)
    : caller_(*problem.kernel),
      kernel_(*problem.kernel),
      alpha_(problem.alpha),
      variables_(kernel_.variables),
      rows_(kernel_.rows),
      columns_(kernel_.columns),
      splittable_(settings.uncertainty == Uncertainty::kVariables ? kernel_.variables
                                                                  : kernel_.motion_variables),
      changing_(variables_),
      structure_(structure),
      form_(form_of(settings.method)),
      sharpens_(settings.entries == Entries::kDerivatives && settings.method != Method::kAuto &&
                settings.method != Method::kClosedForm && knows_derivatives(kernel_, form_)),
      sees_mean_values_(settings.method == Method::kAuto && kernel_.left_derivatives != nullptr &&
                        kernel_.left_product != nullptr),
      sees_determinant_(settings.method == Method::kClosedForm) {
  const std::size_t v = variables_ * kLanes;
  const std::size_t mn = rows_ * columns_ * kLanes;
  const std::size_t nn = columns_ * columns_ * kLanes;
  const std::size_t mm = rows_ * rows_ * kLanes;
  const std::size_t h = kernel_.constraints * kLanes;
  const std::size_t pose = kernel_.pose_parameters * kLanes;
  boxes_ = AlignedBuffer(2 * v);
  thin_ = AlignedBuffer(2 * v);
  thinned_ = AlignedBuffer(2 * v);
  midpoint_ = AlignedBuffer(v);
  radius_ = AlignedBuffer(v);
  matrix_ = AlignedBuffer(2 * mn);
  midpoint_matrix_ = AlignedBuffer(2 * mn);
  approx_matrix_ = AlignedBuffer(mn);
  preconditioner_ = AlignedBuffer(mn);
  left_ = AlignedBuffer(2 * nn);
  left_numeric_ = AlignedBuffer(2 * nn);
  right_ = AlignedBuffer(2 * mm);
  right_numeric_ = AlignedBuffer(2 * mm);
  derivatives_ = AlignedBuffer(sees_mean_values_ || sharpens_ ? 2 * nn * variables_ : 0);
  matrix_derivatives_ = AlignedBuffer(sharpens_ ? 2 * mn * variables_ : 0);
  face_boxes_ = AlignedBuffer(sharpens_ ? 2 * v : 0);
  face_points_ = AlignedBuffer(sharpens_ ? mn : 0);
  face_entries_ = AlignedBuffer(sharpens_ ? 2 * nn : 0);
  if (structure_.is_known()) {
    const regulus_expansion& x = *kernel_.expansion;
    second_order_.emplace(
        listed_derivatives(kernel_), structure_,
        SecondOrderOptions{.moves = settings.ingredients.moving,
                           .weighs_row_variables = splittable_ > kernel_.motion_variables});
    expanded_ = AlignedBuffer(2 * v);
    expanded_radius_ = AlignedBuffer(v);
    center_product_ = AlignedBuffer(2 * nn);
    first_ = AlignedBuffer(2 * kLanes * x.first.count);
    second_ = AlignedBuffer(2 * kLanes * x.second.count);
    row_first_ = AlignedBuffer(2 * kLanes * x.row_first.count);
    row_second_ = AlignedBuffer(2 * kLanes * x.row_second.count);
    second_order_bounds_ = AlignedBuffer(order() * order() * kLanes);
  }
  bounds_ = AlignedBuffer(nn);
  center_ = AlignedBuffer(nn);
  vector_ = AlignedBuffer(order() * kLanes);
  candidate_vector_ = AlignedBuffer(order() * kLanes);
  right_perron_ = AlignedBuffer(order() * kLanes);
  left_perron_ = AlignedBuffer(order() * kLanes);
  impact_ = AlignedBuffer(v);
  determinant_ = AlignedBuffer(2 * kLanes);
  monotone_ = AlignedBuffer(2 * kLanes);
  determinant_slopes_ = AlignedBuffer(sees_determinant_ ? 2 * v : 0);
  face_ = AlignedBuffer(sees_determinant_ ? 2 * v : 0);
  face_center_ = AlignedBuffer(sees_determinant_ ? 2 * v : 0);
  scratch_ = AlignedBuffer(std::max({2 * mn, 2 * nn, 2 * h, 2 * pose}));
}

void Batch::clear() noexcept {
  done_ = 0;
  loaded_ = 0;
}

void Batch::load(std::size_t lane, std::span<const Interval> box) noexcept {
  for (std::size_t k = 0; k < changing_; ++k) load_variable(k, lane, box[k]);
  loaded_ |= 1U << lane;
}

void Batch::load_variable(std::size_t k, std::size_t lane, Interval x) noexcept {
  const bool thin = x.lo == x.hi;
  const double middle = thin ? x.lo : mid(x);
  const double radius = thin ? 0.0 : rad_ru(x);
  boxes_[lower_at(k, lane)] = x.lo;
  boxes_[upper_at(k, lane)] = x.hi;
  midpoint_[point_at(k, lane)] = middle;
  thin_[lower_at(k, lane)] = thin_[upper_at(k, lane)] = middle;
  radius_[point_at(k, lane)] = radius;
}

/// The point to expand at, and how far from it the box reaches.
void Batch::load_expansion_point() noexcept {
  const std::size_t count = expansion_point_known_ ? changing_ : variables_;
  expansion_point_known_ = true;
  std::copy_n(thin_.get(), 2 * count * kLanes, expanded_.get());
  std::copy_n(radius_.get(), count * kLanes, expanded_radius_.get());
  const double* nominal = kernel_.expansion->nominal;
  if (nominal == nullptr) return;
  for (std::size_t k = 0; k < count; ++k) {
    if (!structure_.touches_one_row(k)) continue;
    const double lo = nominal[2 * k], hi = nominal[2 * k + 1];
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      expanded_[lower_at(k, lane)] = lo;
      expanded_[upper_at(k, lane)] = hi;
      const Interval x{boxes_[lower_at(k, lane)], boxes_[upper_at(k, lane)]};
      expanded_radius_[point_at(k, lane)] = std::max(sub_ru(x.hi, lo), sub_ru(hi, x.lo));
    }
  }
  if (count == variables_)
    expansion_outside_contract_ =
        lanes_outside_contract(expanded_.get(), static_cast<unsigned>(variables_));
}

/// To the lanes from `from` on.
void Batch::copy_first_lane(std::size_t from) noexcept {
  const auto copy = [from](double* row) { std::fill(row + from, row + kLanes, row[0]); };
  for (std::size_t k = 0; k < changing_; ++k) {
    for (double* bounds : {boxes_.get(), thin_.get()})
      copy(bounds + lower_at(k, 0)), copy(bounds + upper_at(k, 0));
    copy(midpoint_.get() + point_at(k, 0));
    copy(radius_.get() + point_at(k, 0));
  }
}

void Batch::spread(std::size_t count) noexcept {
  copy_first_lane(1);
  loaded_ = kAllLanes >> (kLanes - count);
}

void Batch::seal(std::size_t count) noexcept {
  copy_first_lane(count);
  // A midpoint, or any other part of a box that is within the contract, is within it too.
  const LaneMask changed = lanes_outside_contract(boxes_.get(), static_cast<unsigned>(changing_));
  outside_contract_ = changing_ < variables_ ? fixed_outside_contract_ | changed : changed;
}

bool Batch::begin(Stage stage) noexcept {
  const bool first = (done_ & stage) == 0;
  done_ |= stage;
  return first;
}

LaneMask Batch::call(regulus_function function, const double* boxes, const double* points,
                     double* out) noexcept {
  if (function == nullptr) return 0;
  const LaneMask undefined = caller_.call_within_contract(function, boxes, points, out);
  if (outside_contract_ != 0) caller_.forget(function, outside_contract_, out);
  return kAllLanes & ~outside_contract_ & ~undefined;
}

void Batch::constraints_on(const double* boxes, LaneMask& inside, LaneMask& outside) noexcept {
  inside = kAllLanes;
  outside = 0;
  if (kernel_.constraints == 0) return;
  // A lane with an undefined constraint is neither inside nor outside.
  const LaneMask defined = call(kernel_.constraint, boxes, nullptr, scratch_.get());
  for (std::size_t h = 0; h < kernel_.constraints; ++h)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (!(scratch_[upper_at(h, lane)] <= 0.0)) inside &= ~(1U << lane);
      if (scratch_[lower_at(h, lane)] > 0.0) outside |= 1U << lane;
    }
  inside &= defined;
  outside &= defined;
}

LaneMask Batch::certain_outside() noexcept {
  if (begin(kConstraints)) constraints_on(boxes_.get(), inside_, outside_);
  return outside_ & loaded_;
}

LaneMask Batch::certain_inside() noexcept {
  if (begin(kConstraints)) constraints_on(boxes_.get(), inside_, outside_);
  return inside_ & loaded_;
}

LaneMask Batch::midpoint_inside() noexcept {
  if (begin(kMidpointConstraints)) constraints_on(thin_.get(), midpoint_inside_, midpoint_outside_);
  return midpoint_inside_ & loaded_;
}

LaneMask Batch::midpoint_outside() noexcept {
  if (begin(kMidpointConstraints)) constraints_on(thin_.get(), midpoint_inside_, midpoint_outside_);
  return midpoint_outside_ & loaded_;
}

void Batch::compute_posed() noexcept {
  posed_ = kAllLanes;
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    scale_[lower_at(0, lane)] = scale_[upper_at(0, lane)] = 1.0;
  if (kernel_.row_scale != nullptr) {
    // Copied at the end: kernels want an aligned array.
    posed_ &= call(kernel_.row_scale, boxes_.get(), nullptr, scratch_.get());
    std::memcpy(scale_, scratch_.get(), sizeof scale_);
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      if (!(scale_[lower_at(0, lane)] > 0.0)) posed_ &= ~(1U << lane);
  }
  if (kernel_.pose != nullptr) posed_ &= call(kernel_.pose, boxes_.get(), nullptr, scratch_.get());
}

LaneMask Batch::certain_posed() noexcept {
  if (posed_everywhere_) return loaded_;
  if (begin(kPosed)) compute_posed();
  return posed_ & loaded_;
}

Interval Batch::row_scale(std::size_t lane) noexcept {
  if (begin(kPosed)) compute_posed();
  return {scale_[lower_at(0, lane)], scale_[upper_at(0, lane)]};
}

const double* Batch::row_scales() noexcept {
  if (begin(kPosed)) compute_posed();
  return scale_;
}

void Batch::learn_from_root() noexcept {
  posed_everywhere_ = has_lane(certain_posed(), 0);
  changing_ = splittable_;
  fixed_outside_contract_ = outside_contract_;
}

bool Batch::certain_above_threshold(std::size_t lane, double lower) noexcept {
  if (!(lower > 0.0) || !has_lane(certain_posed(), lane)) return false;
  return alpha_.hi == 0.0 || mul_rd(lower, row_scale(lane).lo) > alpha_.hi;
}

void Batch::compute_midpoint() noexcept {
  midpoint_defined_ = call(kernel_.matrix, thin_.get(), nullptr, midpoint_matrix_.get());
  midpoints_of(midpoint_matrix_.get(), rows_ * columns_, approx_matrix_.get());
  const LaneMask failed = approx_inverse(approx_matrix_.get(), rows_, columns_,
                                         preconditioner_.get(), approx_determinant_);
  preconditioned_ = midpoint_defined_ & ~failed &
                    lanes_within(preconditioner_.get(), rows_ * columns_, kMaxPointMagnitude);
  for_each_lane(kAllLanes & ~preconditioned_, [this](std::size_t lane) {
    clear_lane(preconditioner_.get(), rows_ * columns_, lane);
  });
}

LaneMask Batch::midpoint_defined() noexcept {
  if (begin(kMidpoint)) compute_midpoint();
  return midpoint_defined_ & loaded_;
}

LaneMask Batch::preconditioned() noexcept {
  if (begin(kMidpoint)) compute_midpoint();
  return preconditioned_ & loaded_;
}

const double* Batch::preconditioner() noexcept {
  if (begin(kMidpoint)) compute_midpoint();
  return preconditioner_.get();
}

/// Heuristic: in plain doubles, of the midpoint alone.
LaneMask Batch::poorly_preconditioned() noexcept {
  constexpr double kPoor = 0.25;
  LaneMask good = preconditioned();
  if (good == 0) return loaded_;
  for (std::size_t i = 0; i < columns_; ++i)
    for (std::size_t j = 0; j < columns_; ++j)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        double sum = i == j ? -1.0 : 0.0;
        for (std::size_t p = 0; p < rows_; ++p)
          sum += preconditioner_[point_at(i * rows_ + p, lane)] *
                 approx_matrix_[point_at(p * columns_ + j, lane)];
        if (!(std::fabs(sum) < kPoor)) good &= ~(1U << lane);
      }
  return loaded_ & ~good;
}

double Batch::approx_determinant(std::size_t lane) noexcept {
  if (begin(kMidpoint)) compute_midpoint();
  return approx_determinant_[lane];
}

void Batch::keep_vector(LaneMask lanes, std::size_t entries) noexcept {
  for_each_lane(lanes, [this, entries](std::size_t lane) {
    for (std::size_t i = 0; i < entries; ++i)
      vector_[point_at(i, lane)] = candidate_vector_[point_at(i, lane)];
  });
}

double Batch::approx_row_scale(std::size_t lane) noexcept {
  if (!begin(kMidpointScale)) return approx_scale_[lane];
  std::fill_n(approx_scale_, kLanes, 1.0);
  if (kernel_.row_scale != nullptr) {
    const LaneMask defined = call(kernel_.row_scale, thin_.get(), nullptr, scratch_.get());
    midpoints_of(scratch_.get(), 1, approx_scale_);
    for_each_lane(kAllLanes & ~defined, [this](std::size_t l) { approx_scale_[l] = 1.0; });
  }
  return approx_scale_[lane];
}

Interval Batch::preconditioner_determinant(std::size_t lane) noexcept {
  return enclose_determinant_by_elimination(point_lane(preconditioner(), columns_, lane));
}

}  // namespace regulus
