// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/arm_tubes.hpp"

#include <algorithm>
#include <cmath>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/question/solve/interval_matrices.hpp"
#include "runtime/existence/branch_tube.hpp"

namespace regulus::detail {
namespace {

constexpr int kStepsToPosture = 12, kTrialsOfTube = 10;
constexpr double kRoomOfTube = 1.25;
constexpr double kLeastRadiusOfTube = 0x1p-40;

/// A joint moves the end, and so does a quantity that varies in the origin before it.
struct Mover {
  std::size_t column;  ///< m quantities, then n unknowns
  Vector3 spin, velocity;
};

class VaryingPosture {
 public:
  VaryingPosture(const ArmAtPlace& arm, std::span<const Interval> unknowns)
      : arm_(arm),
        posture_(posture_at(arm.chain, unknowns)),
        m_(arm.chain.front().rates.size()),
        all_(m_ + unknowns.size()),
        E_(times(posture_.end.R, transposed(arm.target.R))) {
    LinkFrame before;
    for (std::size_t i = 0; i < arm.chain.size(); ++i) {
      for (std::size_t k = 0; k < m_; ++k) add_quantity(before, i, k);
      add_joint(i);
      const ArmJoint& joint = arm.chain[i];
      before = compose(compose(before, joint.origin), joint.moved(joint.value_at(unknowns)));
    }
    for (std::size_t k = 0; k < m_ && !arm.target_rates.empty(); ++k)
      turned_.push_back(times(posture_.end.R, transposed(arm.target_rates[k].R)));
  }

  [[nodiscard]] std::vector<Interval> value() const {
    const Vector3 gap = posture_.end.d - arm_.target.d, turn = axial(E_);
    return projected({gap[0], gap[1], gap[2], turn[0], turn[1], turn[2]});
  }

  /// By all quantities and unknowns.
  [[nodiscard]] std::vector<Interval> derivatives() const {
    std::vector<Interval> rows(6 * all_, Interval(0.0));
    for (const Mover& mover : movers_)
      add(rows, mover.column, mover.velocity, axial(across(mover.spin, E_)));
    for (std::size_t k = 0; k < turned_.size(); ++k)
      add(rows, k, Vector3{0, 0, 0} - arm_.target_rates[k].d, axial(turned_[k]));
    return projected(rows);
  }

  /// The derivatives of those; of two quantities they are `of_quantities`.
  [[nodiscard]] std::vector<std::vector<Interval>> rates(const Interval& of_quantities) const {
    std::vector<std::vector<Interval>> rates(all_, std::vector<Interval>(6 * all_, Interval(0.0)));
    for (std::size_t b = 0; b < movers_.size(); ++b)
      for (std::size_t a = 0; a <= b; ++a) add_pair(rates, movers_[a], movers_[b], a != b);
    for (const Mover& mover : movers_)
      for (std::size_t k = 0; k < turned_.size() && mover.column >= m_; ++k) {
        const Vector3 turn = axial(across(mover.spin, turned_[k]));
        add(rates[mover.column], k, {0, 0, 0}, turn);
        add(rates[k], mover.column, {0, 0, 0}, turn);
      }
    for (std::size_t by = 0; by < all_; ++by) {
      for (std::size_t row = 0; row < 6 && by < m_; ++row)
        std::fill_n(rates[by].begin() + std::ptrdiff_t(row * all_), m_, of_quantities);
      rates[by] = projected(rates[by]);
    }
    return rates;
  }

  [[nodiscard]] std::size_t quantities() const { return m_; }

 private:
  [[nodiscard]] std::vector<Interval> projected(const std::vector<Interval>& rows) const {
    return arm_.direction ? along(*arm_.direction, rows) : rows;
  }

  /// R′Rᵀ of a rotation is skew: the origin turns about its axial vector.
  void add_quantity(const LinkFrame& before, std::size_t joint, std::size_t k) {
    const LinkFrame& rate = arm_.chain[joint].rates[k];
    const LinkFrame& origin = arm_.chain[joint].origin;
    const Vector3 spin = times(before.R, axial(times(rate.R, transposed(origin.R))));
    const Vector3 velocity =
        cross(spin, posture_.end.d - posture_.origins[joint]) + times(before.R, rate.d);
    if (spin == Vector3{0, 0, 0} && velocity == Vector3{0, 0, 0}) return;
    movers_.push_back({k, spin, velocity});
  }

  void add_joint(std::size_t i) {
    const ArmJoint& joint = arm_.chain[i];
    movers_.push_back({m_ + joint.unknown,
                       joint.turns ? joint.factor * posture_.axes[i] : Vector3{0, 0, 0},
                       joint.factor * velocity_by(arm_.chain, posture_, i)});
  }

  void add(std::vector<Interval>& rows, std::size_t column, const Vector3& of_place,
           const Vector3& of_turn) const {
    for (std::size_t i = 0; i < 3; ++i) {
      rows[i * all_ + column] += of_place[i];
      rows[(3 + i) * all_ + column] += of_turn[i];
    }
  }

  /// All links behind the first one turn with it, as one body.
  void add_pair(std::vector<std::vector<Interval>>& rates, const Mover& first, const Mover& second,
                bool is_pair) const {
    if (first.column < m_ && second.column < m_) return;
    const Vector3 of_place = cross(first.spin, second.velocity),
                  of_turn = axial(across(first.spin, across(second.spin, E_)));
    add(rates[first.column], second.column, of_place, of_turn);
    if (is_pair) add(rates[second.column], first.column, of_place, of_turn);
  }

  const ArmAtPlace& arm_;
  const ArmPosture posture_;
  const std::size_t m_, all_;
  const Matrix3 E_;
  std::vector<Mover> movers_;
  std::vector<Matrix3> turned_;  ///< R·R*′ᵀ by quantity; empty: the place does not vary
};

/// Appends the columns of a matrix from `first` on.
void append_columns(std::vector<Interval>& to, const std::vector<Interval>& matrix,
                    std::size_t columns, std::size_t first, std::size_t count) {
  for (std::size_t row = 0; row * columns < matrix.size(); ++row)
    for (std::size_t k = 0; k < count; ++k) to.push_back(matrix[row * columns + first + k]);
}

std::vector<double> middles_of(std::span<const Interval> values) {
  std::vector<double> result;
  for (const Interval& value : values) result.push_back(mid(value));
  return result;
}

std::vector<Interval> as_points(std::span<const double> values) {
  return {values.begin(), values.end()};
}

}  // namespace

VaryingValues varying_values(const ArmAtPlace& arm, std::span<const Interval> unknowns) {
  const VaryingPosture varying(arm, unknowns);
  const std::size_t m = varying.quantities(), n = unknowns.size();
  VaryingValues values;
  values.value = varying.value();
  const std::vector<Interval> derivatives = varying.derivatives();
  append_columns(values.by_variable, derivatives, m + n, 0, m);
  append_columns(values.by_unknown, derivatives, m + n, m, n);
  for (const std::vector<Interval>& rates :
       varying.rates(arm.is_linear ? Interval(0.0) : kEntire)) {
    append_columns(values.rates_by_variable, rates, m + n, 0, m);
    append_columns(values.rates_by_unknown, rates, m + n, m, n);
  }
  return values;
}

void VaryingArm::evaluate(std::span<const Box> boxes, bool are_rates_needed) {
  boxes_.assign(boxes.begin(), boxes.end());
  within_.evaluate(boxes, are_rates_needed);
  nominal_.evaluate(boxes, false);
}

std::optional<RootSystem::Values> VaryingArm::at(std::size_t lane) const {
  auto values = within_.at(lane);
  if (!values || !is_point(boxes_[lane])) return values;
  const std::size_t m = arm_.deviations.size(), n = arm_.unknowns.size();
  values->core = nominal_.at(lane)->value;
  append_columns(values->by_datum, VaryingPosture(arm_, boxes_[lane]).derivatives(), m + n, 0, m);
  values->data = arm_.deviations;
  return values;
}

std::optional<Root> varying_posture_near(const ArmAtPlace& arm, std::vector<double> near) {
  if (!arm.nominal) return std::nullopt;
  const std::vector<Interval>& deviations = arm.deviations;
  const std::size_t n = near.size(), m = deviations.size();
  VaryingValues at;
  std::vector<double> K;
  for (int step = 0; step < kStepsToPosture; ++step) {
    at = varying_values(*arm.nominal, as_points(near));
    const auto inverse = approx_inverse_of(middles_of(at.by_unknown), n);
    if (!inverse) return std::nullopt;
    K = *inverse;
    if (step + 1 == kStepsToPosture) break;
    const std::vector<Interval> steps = product(K, at.value, n);
    for (std::size_t i = 0; i < n; ++i) near[i] -= mid(steps[i]);
  }
  BranchTube tube{
      std::vector<double>(m, 0.0), near, {}, std::vector<double>(n, kLeastRadiusOfTube)};
  for (const Interval& slope : product(K, at.by_variable, n)) tube.slopes.push_back(-mid(slope));
  std::optional<Root> root;
  for (int trial = 0; trial < kTrialsOfTube; ++trial) {
    const VaryingValues over = varying_values(arm, enclose(tube, deviations));
    const TubeImage image =
        image_of(tube, deviations, K,
                 {at.value, over.by_unknown, over.by_variable, at.by_unknown, at.by_variable,
                  over.rates_by_unknown, over.rates_by_variable});
    const bool is_shown = has_one_solution(tube, image);
    if (!is_shown && root) break;
    for (std::size_t i = 0; i < n; ++i)
      tube.radius[i] =
          is_shown ? image.radius[i] : std::fmax(tube.radius[i], kRoomOfTube * image.radius[i]);
    if (!std::ranges::all_of(tube.radius, [](double r) { return std::isfinite(r) && r < 1; }))
      break;
    if (!is_shown) continue;
    // The solution is within the image of its tube.
    root =
        Root{near, tube.radius, enclose(tube, deviations), sign_of_determinant(at.by_unknown, n)};
    for (double& r : tube.radius) r = std::fmax(kRoomOfTube * r, kLeastRadiusOfTube);
  }
  return root;
}

}  // namespace regulus::detail
