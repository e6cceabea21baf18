// SPDX-License-Identifier: Apache-2.0
#include "runtime/solutions/pose_narrowing.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/existence/branch_tube.hpp"
#include "runtime/existence/narrowing.hpp"
#include "runtime/solutions/dual_quaternion.hpp"

namespace regulus::detail {
namespace {

constexpr int kRounds = 8;
/// A round that leaves more of every side is the last one.
constexpr double kWorthwhile = 0.95;
constexpr double kLeastRadius = 0x1p-46;

using Vector = std::array<Interval, 3>;

Interval dot(const Vector& u, const Vector& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }
Vector cross(const Vector& u, const Vector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
Interval square_of(const Vector& v) { return sqr(v[0]) + sqr(v[1]) + sqr(v[2]); }

Quaternion<Interval> unit(const Quaternion<Interval>& x) {
  const Interval norm = sqrt(sqr(x[0]) + sqr(x[1]) + sqr(x[2]) + sqr(x[3]));
  return {x[0] / norm, x[1] / norm, x[2] / norm, x[3] / norm};
}

Vector back(const std::array<Interval, 9>& R, const Vector& v) {
  Vector result;
  for (std::size_t j = 0; j < 3; ++j) result[j] = R[j] * v[0] + R[3 + j] * v[1] + R[6 + j] * v[2];
  return result;
}

}  // namespace

LegsNearPose::LegsNearPose(const GoughLegs& legs, const std::array<double, 4>& rotation,
                           const std::array<double, 3>& position)
    : base_(), platform_(legs.platform) {
  Quaternion<Interval> x;
  std::ranges::copy(rotation, x.begin());
  rotation_ = unit(x);
  matrix_ = rotation_matrix(rotation_);
  std::ranges::copy(position, position_.begin());
  for (std::size_t i = 0; i < kUnknowns; ++i) {
    Vector gap;
    for (std::size_t k = 0; k < 3; ++k) gap[k] = legs.base[i][k] - position_[k];
    base_[i] = back(matrix_, gap);
    square_[i] = square_of(platform_[i]) - sqr(legs.length[i]);
  }
}

LegsNearPose::Values LegsNearPose::at(const Unknowns& z) const {
  const Interval two(2.0);
  const Vector v{z[3], z[4], z[5]};
  const Interval vv = square_of(v), n = Interval(1.0) + vv, less = Interval(1.0) - vv;
  Values values;
  for (std::size_t i = 0; i < kUnknowns; ++i) {
    const Vector& b = platform_[i];
    const Vector gap{z[0] - base_[i][0], z[1] - base_[i][1], z[2] - base_[i][2]};
    const Interval vb = dot(v, b), sum = square_of(gap) + square_[i];
    const Vector turned = cross(v, b), moment = cross(b, gap);
    const Interval along = dot(gap, v), across = dot(gap, b);
    Vector Qb;
    for (std::size_t k = 0; k < 3; ++k) Qb[k] = less * b[k] + two * (vb * v[k] + turned[k]);
    values.value[i] = n * sum + two * dot(gap, Qb);
    for (std::size_t k = 0; k < 3; ++k) {
      values.by_unknown[6 * i + k] = two * (n * gap[k] + Qb[k]);
      // Of Q(v)b, times the gap: −2v_k(b·gap) + 2b_k(v·gap) + 2(v·b)gap_k + 2(b × gap)_k.
      values.by_unknown[6 * i + 3 + k] =
          two * (v[k] * sum + two * (b[k] * along + vb * gap[k] + moment[k] - v[k] * across));
    }
  }
  return values;
}

/// With g = u − c: the derivative of Q(v)b by v_k is 2(b_k v − v_k b + (v·b)e_k + e_k × b), and by v_j, too,
/// 2(b_k e_j + b_j e_k − δ_jk b).
LegsNearPose::Bends LegsNearPose::bends(const Unknowns& z) const {
  const Interval two(2.0), four(4.0);
  const Vector v{z[3], z[4], z[5]};
  const auto at = [](std::size_t j, std::size_t k) { return 3 * j + k; };
  Bends bends;
  bends.by_u = two * (Interval(1.0) + square_of(v));
  for (std::size_t i = 0; i < kUnknowns; ++i) {
    const Vector& b = platform_[i];
    const Vector gap{z[0] - base_[i][0], z[1] - base_[i][1], z[2] - base_[i][2]};
    const Interval vb = dot(v, b);
    const Interval sum = two * (square_of(gap) + square_[i]) - four * dot(gap, b);
    for (std::size_t k = 0; k < 3; ++k) {
      // e_k × b
      const Vector turned = k == 0   ? Vector{Interval(0.0), -b[2], b[1]}
                            : k == 1 ? Vector{b[2], Interval(0.0), -b[0]}
                                     : Vector{-b[1], b[0], Interval(0.0)};
      for (std::size_t j = 0; j < 3; ++j) {
        const Interval turn = b[k] * v[j] - v[k] * b[j] + turned[j];
        bends.by_u_and_v[i][at(j, k)] = four * (v[k] * gap[j] + (j == k ? turn + vb : turn));
        const Interval sides = four * (b[k] * gap[j] + b[j] * gap[k]);
        bends.by_v[i][at(j, k)] = j == k ? sides + sum : sides;
      }
    }
  }
  return bends;
}

std::optional<LegsNearPose::Unknowns> LegsNearPose::unknowns_of(const GoughPose& pose) const {
  const Quaternion<Interval> turn = conj(rotation_) * pose.rotation;
  if (contains_zero(turn[0])) return std::nullopt;
  Vector moved;
  for (std::size_t k = 0; k < 3; ++k) moved[k] = pose.position[k] - position_[k];
  const Vector u = back(matrix_, moved);
  return Unknowns{u[0], u[1], u[2], turn[1] / turn[0], turn[2] / turn[0], turn[3] / turn[0]};
}

GoughPose LegsNearPose::pose_of(const Unknowns& z) const {
  GoughPose pose;
  pose.rotation = rotation_ * unit({Interval(1.0), z[3], z[4], z[5]});
  for (std::size_t i = 0; i < 3; ++i)
    pose.position[i] = position_[i] + (matrix_[3 * i] * z[0] + matrix_[3 * i + 1] * z[1] +
                                       matrix_[3 * i + 2] * z[2]);
  return pose;
}

namespace {

constexpr std::size_t kSize = LegsNearPose::kUnknowns;

/// The mean-value form over a box, times an approximate inverse.
struct MeanValueForm {
  std::array<double, kSize> center{};
  std::array<Interval, kSize> offset;           ///< K times the values at the centre
  std::array<Interval, kSize * kSize> product;  ///< K times the derivatives over the box
};

std::optional<MeanValueForm> mean_value_form(const LegsNearPose& near,
                                             const LegsNearPose::Unknowns& box) {
  MeanValueForm form;
  LegsNearPose::Unknowns middle;
  for (std::size_t k = 0; k < kSize; ++k) middle[k] = form.center[k] = mid(box[k]);
  const auto at = near.at(middle), over = near.at(box);
  std::array<double, kSize * kSize> matrix{};
  std::ranges::transform(at.by_unknown, matrix.begin(), [](Interval x) { return mid(x); });
  const auto K = approx_inverse_of(matrix, kSize);
  if (!K) return std::nullopt;
  form.offset.fill(Interval(0.0)), form.product.fill(Interval(0.0));
  for (std::size_t i = 0; i < kSize; ++i)
    for (std::size_t j = 0; j < kSize; ++j) {
      const Interval factor((*K)[i * kSize + j]);
      form.offset[i] += factor * at.value[j];
      for (std::size_t k = 0; k < kSize; ++k)
        form.product[i * kSize + k] += factor * over.by_unknown[j * kSize + k];
    }
  return form;
}

/// True if |I − A|·r < r for radii r that reach all of the box.
bool is_near_unit(const MeanValueForm& form, const LegsNearPose::Unknowns& box) {
  const auto radius = [&](std::size_t k) {
    return std::fmax(mag(box[k] - Interval(form.center[k])), kLeastRadius);
  };
  for (std::size_t i = 0; i < kSize; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < kSize; ++k)
      sum = add_ru(
          sum, mul_ru(mag(form.product[i * kSize + k] - Interval(i == k ? 1.0 : 0.0)), radius(k)));
    if (!(sum < radius(i))) return false;
  }
  return true;
}

}  // namespace

NarrowedPoses narrow_poses(const GoughLegs& legs, const GoughPose& poses) {
  std::array<double, 4> rotation{};
  std::array<double, 3> position{};
  std::ranges::transform(poses.rotation, rotation.begin(), [](Interval x) { return mid(x); });
  std::ranges::transform(poses.position, position.begin(), [](Interval x) { return mid(x); });
  const LegsNearPose near(legs, rotation, position);
  auto box = near.unknowns_of(poses);
  NarrowedPoses result{poses};
  if (!box || !std::ranges::all_of(*box, is_bounded)) return result;
  bool is_better = true;
  for (int round = 0; round < kRounds && is_better; ++round) {
    const LegsNearPose::Unknowns before = *box;
    const auto form = mean_value_form(near, before);
    if (!form) break;
    result.is_regular = is_near_unit(*form, before);
    if (!narrow_by_rows(form->product, form->offset, form->center, *box)) return {};
    is_better = false;
    for (std::size_t k = 0; k < kSize; ++k)
      is_better = is_better || width_ru((*box)[k]) < kWorthwhile * width_ru(before[k]);
  }
  GoughPose narrow = near.pose_of(*box);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto both = intersect(narrow.position[k], poses.position[k]);
    if (!both) return {};
    narrow.position[k] = *both;
  }
  result.poses = narrow;
  return result;
}

}  // namespace regulus::detail
