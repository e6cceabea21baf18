// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/branch_value.hpp"

#include <algorithm>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/question/quantity/inverse_in_one_unit.hpp"
#include "codegen/question/quantity/quantity_traits.hpp"

namespace regulus::detail {
namespace {

std::vector<Interval> enclosed(const std::vector<GiNaC::ex>& values) {
  std::vector<Interval> result;
  for (const GiNaC::ex& value : values) result.push_back(enclose_constant(value, "a constant"));
  return result;
}

const std::vector<GiNaC::ex>& data_of_motors(const Actuators& motors, QuantityKind kind) {
  static const std::vector<GiNaC::ex> kNone;
  switch (closure_traits_of(kind).data) {
    case NeededData::kMotorErrors:
      return motors.error;
    case NeededData::kMotorSpeeds:
      return motors.speed;
    case NeededData::kLoadAndStiffness:
      return motors.stiffness;
    default:
      return kNone;
  }
}

/// Encloses the largest sum of magnitudes of a row of A·diag(after), divided by its factor.
Interval largest_row(std::span<const Interval> A, std::size_t n, const std::vector<Interval>& after,
                     const std::vector<Interval>& before) {
  Interval most(0.0);
  for (std::size_t i = 0; i < n; ++i) {
    Interval sum(0.0);
    for (std::size_t j = 0; j < n; ++j)
      sum += after.empty() ? abs(A[i * n + j]) : abs(A[i * n + j] * after[j]);
    if (!before.empty()) sum /= before[i];
    if (!(sum.hi < kInfinity)) return {0, kInfinity};
    most = {std::max(most.lo, sum.lo), std::max(most.hi, sum.hi)};
  }
  return most;
}

}  // namespace

BranchValue::BranchValue(const Model& model, const Component& c)
    : kind_(c.kind),
      row_(c.row),
      column_(c.column),
      unknowns_(model.closure->unknowns.size()),
      motors_(model.pose.size()),
      sign_(c.sign),
      is_absolute_(c.is_absolute),
      is_negative_(c.sign < 0 || traits_of(c.kind).is_always_least),
      by_motor_(enclosed(data_of_motors(model.actuators, c.kind))) {
  if (kind_ == QuantityKind::kCondition) factors_ = enclosed(column_scales(model));
  if (SingularValues::are_of(kind_))
    singular_values_.emplace(kind_, enclosed(column_scales(model)));
  if (c.set != nullptr) take_load(*c.set);
}

BranchValue::BranchValue(const Model& model, const VectorSet& load)
    : kind_(QuantityKind::kForce),
      row_(0),
      column_(0),
      unknowns_(model.closure->unknowns.size()),
      motors_(model.pose.size()),
      sign_(1),
      is_absolute_(false),
      is_negative_(false) {
  take_load(load);
  for (const Range& limit : model.actuators.force) {
    least_.push_back(enclose_constant(limit.lo, "the least force"));
    most_.push_back(enclose_constant(limit.hi, "the largest force"));
  }
}

void BranchValue::take_load(const VectorSet& set) {
  for (const GeometryParameter& entry : set.entries) {
    middle_.push_back(enclose_constant(entry.value, entry.name));
    spread_.push_back(entry.ball < 0 ? enclose_constant(entry.tolerance, entry.name)
                                     : Interval(0.0));
  }
  for (const ToleranceBall& ball : set.balls)
    balls_.push_back({enclose_constant(ball.radius, "a radius"), ball.members});
}

DerivativesBy BranchValue::needed(QuantityKind kind) {
  if (kind == QuantityKind::kFiniteError) return DerivativesBy::kVariablesAndNominal;
  const bool is_of_matrix = kind == QuantityKind::kCondition ||
                            kind == QuantityKind::kDeterminant ||
                            kind == QuantityKind::kDeterminantMax || SingularValues::are_of(kind);
  return is_of_matrix ? DerivativesBy::kVariables : DerivativesBy::kVariablesAndPose;
}

Interval BranchValue::largest(const BranchRates& rates, const SystemBoxes::System& over) const {
  if (kind_ == QuantityKind::kCondition) return condition(rates, over);
  if (kind_ == QuantityKind::kDeterminant) return -abs(rates.determinant());
  if (kind_ == QuantityKind::kDeterminantMax) {
    const Interval det = rates.determinant();
    return is_absolute_ ? abs(det) : Interval(sign_) * det;
  }
  const std::vector<Interval> J = rates.derivatives(over.by_pose, motors_);
  if (!least_.empty()) return beyond_limits(J, nullptr);
  switch (kind_) {
    case QuantityKind::kForce:
      return of_load(along_motor(J, row_));
    case QuantityKind::kDeflection:
      return of_load(compliance(J));
    default:
      return of_motors(J);
  }
}

/// p_i − p°_i = c_i − c°_i + (S_i − S°_i)(x − x₀) + ρ_i − ρ°_i.
Interval BranchValue::distance(const BranchTube& tube, std::span<const Interval> box) const {
  const std::size_t i = column_, j = column_ + unknowns_, m = tube.at.size();
  const double radius = add_ru(tube.radius[i], tube.radius[j]);
  Interval sum = Interval(tube.center[i]) - Interval(tube.center[j]) + Interval(-radius, radius);
  for (std::size_t k = 0; k < m; ++k)
    sum += (Interval(tube.slopes[i * m + k]) - Interval(tube.slopes[j * m + k])) *
           (box[k] - Interval(tube.at[k]));
  return abs(sum);
}

std::vector<double> BranchValue::farthest(const BranchTube& tube,
                                          std::span<const Interval> box) const {
  const std::size_t i = column_, j = column_ + unknowns_, m = tube.at.size();
  double middle = tube.center[i] - tube.center[j];
  std::vector<double> slope(m);
  for (std::size_t k = 0; k < m; ++k) {
    slope[k] = tube.slopes[i * m + k] - tube.slopes[j * m + k];
    middle += slope[k] * (mid(box[k]) - tube.at[k]);
  }
  std::vector<double> corner(m);
  for (std::size_t k = 0; k < m; ++k)
    corner[k] = slope[k] == 0                       ? mid(box[k])
                : (slope[k] > 0) == (middle >= 0.0) ? box[k].hi
                                                    : box[k].lo;
  return corner;
}

std::vector<double> BranchValue::impact_on_distance(const TubeImage& image, std::size_t m) const {
  std::vector<double> impact(m);
  for (std::size_t k = 0; k < m; ++k)
    impact[k] = image.impact[column_ * m + k] + image.impact[(column_ + unknowns_) * m + k];
  return impact;
}

ForceBeyond BranchValue::farthest_beyond(const BranchRates& rates,
                                         const SystemBoxes::System& over) const {
  ForceBeyond farthest;
  static_cast<void>(beyond_limits(rates.derivatives(over.by_pose, motors_), &farthest));
  return farthest;
}

std::vector<Interval> BranchValue::along_motor(const std::vector<Interval>& J,
                                               std::size_t k) const {
  std::vector<Interval> along(unknowns_);
  for (std::size_t i = 0; i < unknowns_; ++i) along[i] = J[i * motors_ + k];
  return along;
}

/// `farthest`: null, or where the motor with the largest part is put.
Interval BranchValue::beyond_limits(const std::vector<Interval>& J, ForceBeyond* farthest) const {
  double lo = -kInfinity, hi = -kInfinity;
  for (std::size_t k = 0; k < motors_; ++k) {
    const std::vector<Interval> along = along_motor(J, k);
    const Work work = this->work(along);
    const double room = mid(most_[k]) - mid(least_[k]);
    const Interval unit(room > 0 && room < kInfinity ? room : 1.0);
    for (const bool is_above : {true, false}) {
      const Interval force = is_above ? work.middle + work.spread : work.middle - work.spread;
      const Interval part = (is_above ? force - most_[k] : least_[k] - force) / unit;
      if (!(part.hi < kInfinity) || !(part.lo > -kInfinity)) return {-kInfinity, kInfinity};
      if (farthest != nullptr && part.lo > lo) *farthest = {k, is_above, force, along};
      lo = std::max(lo, part.lo), hi = std::max(hi, part.hi);
    }
  }
  return {lo, hi};
}

BranchValue::Work BranchValue::work(std::span<const Interval> along) const {
  Interval middle(0.0), spread(0.0);
  for (std::size_t i = 0; i < along.size(); ++i) {
    middle += along[i] * middle_[i];
    spread += abs(along[i]) * spread_[i];
  }
  for (const Ball& ball : balls_) {
    Interval squares(0.0);
    for (const std::size_t i : ball.members) squares += sqr(along[i]);
    spread += ball.radius * sqrt(squares);
  }
  return {middle, spread};
}

/// The largest value of along·w over the load, with the sign, or of its magnitude.
Interval BranchValue::of_load(std::span<const Interval> along) const {
  const Work work = this->work(along);
  return (is_absolute_ ? abs(work.middle) : Interval(sign_) * work.middle) + work.spread;
}

Interval BranchValue::of_motors(const std::vector<Interval>& J) const {
  Interval sum(0.0);
  for (std::size_t k = 0; k < motors_; ++k) sum += abs(J[column_ * motors_ + k]) * by_motor_[k];
  return sum;
}

/// Row `column_` of G.
std::vector<Interval> BranchValue::compliance(const std::vector<Interval>& J) const {
  std::vector<Interval> row(unknowns_, Interval(0.0));
  for (std::size_t j = 0; j < unknowns_; ++j)
    for (std::size_t k = 0; k < motors_; ++k) {
      const Interval& own = J[column_ * motors_ + k];
      row[j] += (j == column_ ? sqr(own) : own * J[j * motors_ + k]) / by_motor_[k];
    }
  return row;
}

Interval BranchValue::condition(const BranchRates& rates, const SystemBoxes::System& over) const {
  return largest_row(over.by_unknown, unknowns_, factors_, {}) *
         largest_row(rates.inverse(), unknowns_, {}, factors_);
}

}  // namespace regulus::detail
