// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/arm_chain.hpp"

#include <algorithm>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/degrees.hpp"
#include "codegen/model/exact/exact_algebra.hpp"
#include "codegen/model/mechanism/rotation.hpp"
#include "codegen/model/place.hpp"
#include "codegen/question/solve/arm_unknowns.hpp"
#include "codegen/question/solve/nominal.hpp"
#include "codegen/question/solve/platform_legs.hpp"
#include "codegen/question/solve/varying_place.hpp"
#include "runtime/interval/elementary.hpp"

namespace regulus::detail {
namespace {

/// c·I + s·[a]× + (1 − c)·a·aᵀ.
Matrix3 turn(const Vector3& a, const Interval& angle) {
  const SinCos t = sincos(angle);
  const Interval rest = Interval(1.0) - t.cos;
  Matrix3 R;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      if (i == j) {  // one cosine
        R[3 * i + j] = sqr(a[i]) + t.cos * (Interval(1.0) - sqr(a[i]));
        continue;
      }
      const Interval part = t.sin * a[3 - i - j];
      R[3 * i + j] = rest * (a[i] * a[j]) + (j == (i + 1) % 3 ? -part : part);
    }
  return R;
}

}  // namespace

Vector3 axial(const Matrix3& M) noexcept {
  const Interval half(0.5);
  return {half * (M[7] - M[5]), half * (M[2] - M[6]), half * (M[3] - M[1])};
}

Matrix3 across(const Vector3& z, const Matrix3& A) noexcept {
  return times(Matrix3{0.0, -z[2], z[1], z[2], 0.0, -z[0], -z[1], z[0], 0.0}, A);
}

LinkFrame compose(const LinkFrame& first, const LinkFrame& second) noexcept {
  return {times(first.R, second.R), times(first.R, second.d) + first.d};
}

LinkFrame inverse(const LinkFrame& frame) noexcept {
  const Matrix3 back = transposed(frame.R);
  return {back, times(back, Vector3{0, 0, 0} - frame.d)};
}

FrameRates rates_of_product(const LinkFrame& first, const FrameRates& of_first,
                            const LinkFrame& second, const FrameRates& of_second) {
  FrameRates rates;
  for (std::size_t k = 0; k < std::max(of_first.size(), of_second.size()); ++k) {
    LinkFrame rate{Matrix3{}, Vector3{}};
    const auto add = [&rate](const Matrix3& R, const Vector3& d) {
      for (std::size_t e = 0; e < 9; ++e) rate.R[e] += R[e];
      rate.d = rate.d + d;
    };
    if (!of_first.empty())
      add(times(of_first[k].R, second.R), times(of_first[k].R, second.d) + of_first[k].d);
    if (!of_second.empty()) add(times(first.R, of_second[k].R), times(first.R, of_second[k].d));
    rates.push_back(rate);
  }
  return rates;
}

FrameRates rates_of_inverse(const LinkFrame& frame, const FrameRates& rates) {
  FrameRates result;
  for (const LinkFrame& rate : rates) {
    const Matrix3 back = transposed(rate.R);
    result.push_back(
        {back, Vector3{0, 0, 0} - times(back, frame.d) - times(transposed(frame.R), rate.d)});
  }
  return result;
}

LinkFrame ArmJoint::moved(const Interval& value) const noexcept {
  LinkFrame frame;
  if (turns)
    frame.R = turn(axis, value);
  else
    frame.d = value * axis;
  return frame;
}

FrameRates ArmJoint::rates_of_moved(const ArmValue& value) const {
  const Matrix3 turned = turns ? across(axis, turn(axis, value.value)) : Matrix3{};
  FrameRates of_frame;
  for (const Interval& rate : value.rates) {
    LinkFrame& frame = of_frame.emplace_back(LinkFrame{turned, {0, 0, 0}});
    for (Interval& entry : frame.R) entry *= rate;
    if (!turns) frame.d = rate * axis;
  }
  return of_frame;
}

ArmValue operator*(const Interval& factor, const ArmValue& value) {
  ArmValue product{factor * value.value, value.rates};
  for (Interval& rate : product.rates) rate *= factor;
  return product;
}

namespace {

/// Encloses numbers of an arm.
class ArmNumbers {
 public:
  ArmNumbers(const Model& model, ArmGeometry geometry)
      : model_(model), geometry_(geometry), nominal_(model) {}

  [[nodiscard]] Interval enclose(const GiNaC::ex& number) const {
    constexpr const char* kWhat = "a number of the arm";
    return geometry_ == ArmGeometry::kNominal ? enclose_constant(nominal_.at(number), kWhat)
                                              : enclose_uncertain(model_, number, kWhat);
  }
  [[nodiscard]] FrameRates rates(const Placement& placement,
                                 const std::vector<GiNaC::realsymbol>& varying) const {
    FrameRates rates;
    for (const GiNaC::realsymbol& symbol : varying) {
      const auto rate = [&](const GiNaC::ex& number) {
        const GiNaC::ex derivative = number.diff(symbol);
        return derivative.is_zero() ? Interval(0.0) : enclose(derivative);
      };
      LinkFrame& frame = rates.emplace_back();
      for (unsigned i = 0; i < 3; ++i) {
        frame.d[i] = rate(placement.p[i]);
        for (unsigned j = 0; j < 3; ++j) frame.R[3 * i + j] = rate(placement.R(i, j));
      }
    }
    return rates;
  }
  [[nodiscard]] LinkFrame enclose(const Placement& placement) const {
    LinkFrame frame;
    for (unsigned i = 0; i < 3; ++i) {
      frame.d[i] = enclose(placement.p[i]);
      for (unsigned j = 0; j < 3; ++j) frame.R[3 * i + j] = enclose(placement.R(i, j));
    }
    return frame;
  }

 private:
  const Model& model_;
  const ArmGeometry geometry_;
  const NominalGeometry nominal_;
};

}  // namespace

ArmChain enclose_chain(const Model& model, ArmGeometry geometry,
                       const std::vector<GiNaC::realsymbol>& varying) {
  const ArmNumbers numbers(model, geometry);
  const std::vector<JointRule> rules = joint_rules(*model.arm);
  ArmChain chain;
  for (std::size_t j = 0; j < rules.size(); ++j) {
    const SerialJoint& joint = model.arm->joints[j];
    ArmJoint& enclosing = chain.emplace_back();
    enclosing.turns = joint.kind == JointKind::kRevolute;
    enclosing.origin = numbers.enclose(joint.origin);
    enclosing.rates = numbers.rates(joint.origin, varying);
    for (std::size_t i = 0; i < 3; ++i) enclosing.axis[i] = numbers.enclose(joint.axis[i]);
    enclosing.unknown = rules[j].unknown;
    enclosing.factor = enclose_constant(rules[j].factor, "a multiplier");
    if (rules[j].offset.is_zero()) continue;
    const Interval offset = enclose_constant(rules[j].offset, "an offset");
    const LinkFrame moved = enclosing.moved(offset);
    enclosing.rates = rates_of_product(enclosing.origin, enclosing.rates, moved, {});
    enclosing.origin = compose(enclosing.origin, moved);
  }
  return chain;
}

namespace {

/// By joint, without what is added to it; 0: the tool brings the joint to its value.
std::vector<GiNaC::ex> commanded_values(const Request& request) {
  const Model& model = request.model;
  const Motion& motion = request.motion;
  const NominalGeometry nominal(model);
  const bool is_by_tool = !motion.tool.empty();
  std::vector<GiNaC::ex> values = is_by_tool ? motion.pose : pose_of(motion);
  const std::vector<ArmUnknown> unknowns = unknowns_of(*model.arm);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool turns_in_degrees = unknowns[i].turns && is_in_degrees(model.pose[i].unit);
    const bool is_free = is_by_tool && !keeps_value(model, motion, i);
    values[i] = is_free ? GiNaC::ex(0)
                        : nominal.at(values[i] * (turns_in_degrees ? one_degree() : GiNaC::ex(1)));
  }
  return values;
}

}  // namespace

std::vector<ArmValue> enclose_values(const Request& request, const Model& model,
                                     ArmGeometry geometry,
                                     const std::vector<GiNaC::realsymbol>& varying) {
  const ArmNumbers numbers(model, geometry);
  const std::vector<ArmUnknown> unknowns = unknowns_of(*model.arm);
  const std::vector<GiNaC::ex> commanded = commanded_values(request);
  std::vector<ArmValue> values;
  for (std::size_t i = 0; i < commanded.size(); ++i) {
    const GiNaC::ex scale = long(unknowns[i].scale);
    const GiNaC::ex added = added_to_pose(request.motion, i) / scale;
    ArmValue& value =
        values.emplace_back(ArmValue{enclose_constant(commanded[i] / scale, model.pose[i].name)});
    if (added.is_zero()) continue;
    value.value += numbers.enclose(added);
    for (const GiNaC::realsymbol& symbol : varying)
      value.rates.push_back(numbers.enclose(added.diff(symbol)));
  }
  return values;
}

std::pair<LinkFrame, FrameRates> enclose_target(const Model& model,
                                                const std::vector<GiNaC::ex>& tool,
                                                ArmGeometry geometry,
                                                const std::vector<GiNaC::realsymbol>& varying) {
  const Placement place{rotation_roll_pitch_yaw(tool[3], tool[4], tool[5]),
                        {tool[0], tool[1], tool[2]}};
  const bool varies = std::ranges::any_of(tool, has_symbols);
  const ArmNumbers numbers(model, geometry),
      of_place(model, varies ? geometry : ArmGeometry::kNominal);
  const LinkFrame at = of_place.enclose(place), tip = numbers.enclose(model.arm->tool);
  const FrameRates rates = rates_of_inverse(tip, numbers.rates(model.arm->tool, varying)),
                   of_at = varies ? of_place.rates(place, varying) : FrameRates{};
  return {compose(at, inverse(tip)), rates_of_product(at, of_at, inverse(tip), rates)};
}

std::pair<LinkFrame, FrameRates> end_of(const ArmChain& chain,
                                        const std::vector<ArmValue>& values) {
  LinkFrame end;
  FrameRates rates;
  for (const ArmJoint& joint : chain) {
    rates = rates_of_product(end, rates, joint.origin, {});
    end = compose(end, joint.origin);
    const ArmValue value = joint.factor * values[joint.unknown];
    rates = rates_of_product(end, rates, joint.moved(value.value), joint.rates_of_moved(value));
    end = compose(end, joint.moved(value.value));
  }
  return {end, rates};
}

ArmPosture posture_at(const ArmChain& chain, std::span<const Interval> unknowns) {
  ArmPosture posture;
  for (const ArmJoint& joint : chain) {
    const LinkFrame at = compose(posture.end, joint.origin);
    posture.axes.push_back(times(at.R, joint.axis));
    posture.origins.push_back(at.d);
    posture.end = compose(at, joint.moved(joint.value_at(unknowns)));
  }
  return posture;
}

Vector3 velocity_by(const ArmChain& chain, const ArmPosture& posture, std::size_t joint) {
  const Vector3& z = posture.axes[joint];
  return chain[joint].turns ? cross(z, posture.end.d - posture.origins[joint]) : z;
}

std::vector<Interval> jacobian_at(const ArmChain& chain, const ArmPosture& posture,
                                  std::size_t unknowns) {
  std::vector<Interval> J(6 * unknowns, Interval(0.0));
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const Vector3 v = velocity_by(chain, posture, k);
    for (std::size_t i = 0; i < 3; ++i) {
      J[i * unknowns + chain[k].unknown] += chain[k].factor * v[i];
      if (chain[k].turns)
        J[(3 + i) * unknowns + chain[k].unknown] += chain[k].factor * posture.axes[k][i];
    }
  }
  return J;
}

}  // namespace regulus::detail
