// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/arm_system.hpp"

#include <cmath>
#include <utility>

#include "codegen/question/solve/approx_vectors.hpp"

namespace regulus::detail {
std::optional<RootSystem::Values> WholeArm::at(std::size_t lane) const {
  const ArmPosture posture = posture_at(chain_, boxes_[lane]);
  const Matrix3 E = times(posture.end.R, transposed(target_.R));
  const Vector3 gap = posture.end.d - target_.d, turn = axial(E);
  Values values;
  for (const Vector3* part : {&gap, &turn})
    values.value.insert(values.value.end(), part->begin(), part->end());
  const std::size_t n = boxes_[lane].size();
  values.by_unknown.assign(kJoints * n, Interval(0.0));
  for (std::size_t k = 0; k < chain_.size(); ++k) {
    const Vector3 v = velocity_by(chain_, posture, k);
    const Vector3 rate =
        chain_[k].turns ? axial(across(posture.axes[k], E)) : Vector3{0.0, 0.0, 0.0};
    for (std::size_t i = 0; i < 3; ++i) {
      values.by_unknown[i * n + chain_[k].unknown] += chain_[k].factor * v[i];
      values.by_unknown[(3 + i) * n + chain_[k].unknown] += chain_[k].factor * rate[i];
    }
  }
  values.also = {Interval(3.0) - (E[0] + E[4] + E[8])};
  if (has_rates_ && are_rates_needed_) add_rates(values, n, posture, E);
  return values;
}

void WholeArm::add_rates(Values& values, std::size_t n, const ArmPosture& posture,
                         const Matrix3& E) const {
  values.rates_by_unknown.assign(n * kJoints * n, Interval(0.0));
  for (std::size_t k = 0; k < chain_.size(); ++k) {
    const Vector3 v = velocity_by(chain_, posture, k);
    for (std::size_t j = 0; j <= k; ++j) {
      if (!chain_[j].turns) continue;
      const Interval factor = chain_[j].factor * chain_[k].factor;
      const Vector3 of_place = factor * cross(posture.axes[j], v);
      const Vector3 of_turn =
          chain_[k].turns ? factor * axial(across(posture.axes[j], across(posture.axes[k], E)))
                          : Vector3{0.0, 0.0, 0.0};
      const auto add = [&](std::size_t by, std::size_t column) {
        for (std::size_t i = 0; i < 3; ++i) {
          values.rates_by_unknown[(by * kJoints + i) * n + column] += of_place[i];
          values.rates_by_unknown[(by * kJoints + 3 + i) * n + column] += of_turn[i];
        }
      };
      add(chain_[j].unknown, chain_[k].unknown);
      if (j < k) add(chain_[k].unknown, chain_[j].unknown);
    }
  }
}

std::vector<Interval> along(const Vector3& n, const std::vector<Interval>& rows) {
  const std::size_t m = rows.size() / 6;
  std::vector<Interval> result(rows.begin(), rows.begin() + std::ptrdiff_t(3 * m));
  for (std::size_t k = 0; k < m; ++k)
    result.push_back(dot(n, {rows[3 * m + k], rows[4 * m + k], rows[5 * m + k]}));
  return result;
}

std::optional<RootSystem::Values> ArmAboutDirection::at(std::size_t lane) const {
  auto values = whole_.at(lane);
  if (!values) return std::nullopt;
  values->value = along(direction_, values->value);
  values->by_unknown = along(direction_, values->by_unknown);
  std::vector<Interval> rates;
  const std::size_t size = 6 * kFourJoints;
  for (std::size_t k = 0; k * size < values->rates_by_unknown.size(); ++k) {
    const auto first = values->rates_by_unknown.begin() + std::ptrdiff_t(k * size);
    const auto of_unknown =
        along(direction_, std::vector<Interval>(first, first + std::ptrdiff_t(size)));
    rates.insert(rates.end(), of_unknown.begin(), of_unknown.end());
  }
  values->rates_by_unknown = std::move(rates);
  return values;
}

ArmLoop rotated_loop(const ArmLoop& arm, std::size_t first) {
  if (first == 0) return arm;
  // O₁J₁…O₆J₆ = T is J₁O₂J₂…J₆(T⁻¹O₁) = I.
  ArmLoop loop;
  for (std::size_t i = 0; i < kJoints; ++i) {
    ArmJoint joint = arm.chain[(i + first) % kJoints];
    if ((i + first) % kJoints == 0) {
      const LinkFrame back = inverse(arm.target);
      joint.rates = rates_of_product(back, rates_of_inverse(arm.target, arm.target_rates),
                                     joint.origin, joint.rates);
      joint.origin = compose(back, joint.origin);
    }
    loop.chain.push_back(joint);
  }
  ArmJoint& start = loop.chain[0];
  loop.target = inverse(start.origin);
  loop.target_rates = rates_of_inverse(start.origin, start.rates);
  start.origin = LinkFrame();
  start.rates.clear();
  return loop;
}

namespace {

/// Moves the origin of a joint by a constant along its axis.
void move_origin(ArmLoop& arm, std::size_t joint, double by) {
  ArmChain& chain = arm.chain;
  LinkFrame shift, back;
  shift.d = Interval(by) * chain[joint].axis;
  back.d = Interval(-by) * chain[joint].axis;
  const auto put_behind = [](LinkFrame& frame, FrameRates& rates, const LinkFrame& other) {
    rates = rates_of_product(frame, rates, other, {});
    frame = compose(frame, other);
  };
  put_behind(chain[joint].origin, chain[joint].rates, shift);
  if (joint + 1 == chain.size()) return put_behind(arm.target, arm.target_rates, shift);
  ArmJoint& next = chain[joint + 1];
  next.rates = rates_of_product(back, {}, next.origin, next.rates);
  next.origin = compose(back, next.origin);
}

}  // namespace

void move_origins(ArmLoop& arm, ArmLoop* alike) {
  const ArmChain& chain = arm.chain;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    // Along the axis, seen from the joint before: d + t·a is to be nearest to the line of b.
    const Point3 b = middle(chain[i - 1].axis), d = middle(chain[i].origin.d);
    const Point3 a = middle(times(chain[i].origin.R, chain[i].axis));
    const double ab = approx_dot(a, b), across = 1 - ab * ab;
    if (!chain[i].turns) continue;
    const double t =
        across < 1e-12 ? -approx_dot(d, a) : (ab * approx_dot(d, b) - approx_dot(d, a)) / across;
    if (!std::isfinite(t)) continue;
    move_origin(arm, i, t);
    if (alike != nullptr) move_origin(*alike, i, t);
  }
}

}  // namespace regulus::detail
