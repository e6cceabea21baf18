// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/leg_rows.hpp"

#include <algorithm>
#include <array>

namespace regulus::verifier {
namespace {

constexpr std::array<LegType, 14> kTypes = {{{"RPR", LegKind::kTelescopic, true, false},
                                             {"RRR", LegKind::kCrank, true, false},
                                             {"PRR", LegKind::kSlider, true, false},
                                             {"UPS", LegKind::kTelescopic, false, false},
                                             {"SPS", LegKind::kTelescopic, false, false},
                                             {"UPU", LegKind::kTelescopic, false, true},
                                             {"RUS", LegKind::kCrank, false, false},
                                             {"RSS", LegKind::kCrank, false, false},
                                             {"delta", LegKind::kCrank, false, true},
                                             {"PUS", LegKind::kSlider, false, false},
                                             {"PSS", LegKind::kSlider, false, false},
                                             {"linear-delta", LegKind::kSlider, false, true},
                                             {"RPS", LegKind::kTelescopic, false, false, true},
                                             {"PRS", LegKind::kSlider, false, false, true}}};

}  // namespace

const LegType* find_leg_type(std::string_view word) {
  const auto* const type = std::ranges::find(kTypes, word, &LegType::name);
  return type == kTypes.end() ? nullptr : type;
}

LegAtPose::LegAtPose(const LegValues& leg, const VectorNodes& position, const MatrixNodes& R,
                     GraphAlgebra& algebra)
    : leg_(leg), g_(algebra), R_(R) {
  r = g_.product(R, leg.platform);
  e = g_.sum(g_.difference(position, leg.base), r);
  d = g_.zero();
  if (leg.kind == LegKind::kTelescopic) rho = g_.root(g_.dot(e, e));
  if (leg.kind == LegKind::kCrank) find_crank();
  if (leg.kind == LegKind::kSlider) find_carriage();
  const bool has_oblique_rail = leg.kind == LegKind::kSlider && !leg.has_exact_directions;
  if (leg.is_hinged) off = g_.dot(has_oblique_rail ? d : e, leg.hinge);
}

/// The crank c is across the axis n, |c| is its length, and c·e = (|e|² + |c|² − rod²)/2, because
/// |e − c| is the rod. With N = |n|², e′ = N·e − (e·n)n, m = n × e and q = |m|² = e·e′ these give
/// c = |c|(k·e′ ± w·m)/q with k = c·e/|c| and w² = q − N·k².
void LegAtPose::find_crank() {
  const VectorNodes& n = leg_.axis;
  const NodeId along = g_.dot(e, n), square = g_.dot(e, e), N = leg_.size;
  const NodeId q = g_.difference(g_.product(N, square), g_.square(along));
  const VectorNodes across = g_.difference(g_.scaled(N, e), g_.scaled(along, n));
  const NodeId lengths = g_.difference(g_.square(leg_.crank), g_.square(leg_.rod));
  const NodeId k = g_.quotient(g_.sum(square, lengths), g_.product(g_.number(2), leg_.crank));
  w = g_.root(g_.difference(q, g_.product(N, g_.square(k))));
  const VectorNodes side = g_.scaled(leg_.mode ? w : g_.negative(w), g_.cross(n, e));
  const NodeId factor = g_.quotient(leg_.crank, q);
  d = g_.difference(e, g_.scaled(factor, g_.sum(g_.scaled(k, across), side)));
}

/// The carriage is at t·n, and |e − t·n| is the rod: N·t = e·n ± w with w² = (e·n)² − N(|e|² − rod²).
void LegAtPose::find_carriage() {
  const VectorNodes& n = leg_.axis;
  const NodeId along = g_.dot(e, n), N = leg_.size;
  const NodeId rest = g_.difference(g_.dot(e, e), g_.square(leg_.rod));
  w = g_.root(g_.difference(g_.square(along), g_.product(N, rest)));
  const NodeId t = g_.quotient(leg_.mode ? g_.sum(along, w) : g_.difference(along, w), N);
  place = g_.product(t, g_.root(N));
  d = g_.difference(e, g_.scaled(t, n));
}

/// `point` is seen from the platform's origin.
LegRow LegAtPose::force_through(const VectorNodes& point, const VectorNodes& force, NodeId scale) {
  return {force, g_.cross(point, force), g_.quotient(g_.number(1), scale)};
}

VectorNodes LegAtPose::quarter(const VectorNodes& v) { return {g_.negative(v[1]), v[0], v[2]}; }

LegRow LegAtPose::motor() {
  if (leg_.kind == LegKind::kTelescopic) return motor_of_telescopic();
  return leg_.kind == LegKind::kCrank ? motor_of_crank() : motor_of_slider();
}

/// The force that no passive joint gives way to, divided by its power at unit speed of the motor.
/// Along the actuator; if a joint turns: across it, through the other joint.
LegRow LegAtPose::motor_of_telescopic() {
  if (leg_.actuated == 2) return force_through(r, e, rho);
  const VectorNodes from = leg_.actuated == 1 ? r : g_.difference(r, e);
  return force_through(from, quarter(e), g_.square(rho));
}

/// The lines through two of the joints A, C and B. The power of each is |c × d|·rate, and |c × d| =
/// |c|·w/|n|.
LegRow LegAtPose::motor_of_crank() {
  LegRow row = force_through(r, d, g_.number(1));
  const VectorNodes crank = g_.difference(e, d);
  if (leg_.actuated == 2) row = force_through(r, e, g_.number(1));
  if (leg_.actuated == 3) row = force_through(g_.difference(r, d), crank, g_.number(1));
  row.scale = g_.quotient(g_.root(leg_.size), g_.product(leg_.crank, w));
  return row;
}

/// Along the rod, where d·n = ∓w; if a joint turns: across the rail, through the other joint.
LegRow LegAtPose::motor_of_slider() {
  if (leg_.actuated == 1) {
    LegRow row = force_through(r, d, w);
    row.scale = g_.quotient(g_.root(leg_.size), w);
    return row;
  }
  return force_through(leg_.actuated == 2 ? r : g_.difference(r, d), quarter(leg_.axis), w);
}

/// Across the bar and the rod. The inner axes of UPU are along n × e: across these and n.
VectorNodes LegAtPose::moment() {
  if (leg_.kind != LegKind::kTelescopic) return g_.cross(leg_.bar, d);
  return g_.difference(g_.scaled(leg_.size, e), g_.scaled(g_.dot(leg_.axis, e), leg_.axis));
}

/// At B and across h × rod: in the plane of the hinge h and the rod. On a rail u it has the power
/// u·force at unit speed: h if that is 0, or else (rod·u)h − (h·u)rod.
LegRow LegAtPose::hinge_force() {
  const VectorNodes &h = leg_.hinge, &u = leg_.axis;
  if (leg_.kind != LegKind::kSlider || leg_.has_exact_directions)
    return force_through(r, h, g_.number(1));
  const VectorNodes force = g_.difference(g_.scaled(g_.dot(d, u), h), g_.scaled(g_.dot(h, u), d));
  return force_through(r, force, g_.number(1));
}

std::vector<NodeId> LegAtPose::range() {
  const auto [lo, hi] = *leg_.range;
  const bool is_length = leg_.kind == LegKind::kTelescopic && leg_.actuated == 2;
  if (is_length) {
    const NodeId square = g_.dot(e, e);
    return {g_.difference(g_.square(lo), square), g_.difference(square, g_.square(hi))};
  }
  if (leg_.kind == LegKind::kTelescopic) {
    if (leg_.actuated == 1) return {angle_range(e[0], e[1], rho)};
    return {angle_to_platform(e, rho)};
  }
  if (leg_.actuated == 3) return {angle_to_platform(d, leg_.rod)};
  if (leg_.kind == LegKind::kSlider) {
    if (leg_.actuated == 1) return {g_.difference(lo, place), g_.difference(place, hi)};
    return {angle_range(g_.dot(leg_.axis, d), g_.cross(leg_.axis, d)[2],
                        g_.product(g_.root(leg_.size), leg_.rod))};
  }
  const VectorNodes crank = g_.difference(e, d);
  if (leg_.actuated == 2)
    return {angle_range(g_.dot(crank, d), g_.cross(crank, d)[2], g_.product(leg_.crank, leg_.rod))};
  if (leg_.is_planar) return {angle_range(crank[0], crank[1], leg_.crank)};
  const VectorNodes &n = leg_.axis, &zero = leg_.zero;
  const NodeId across =
      g_.difference(g_.dot(zero, zero), g_.quotient(g_.square(g_.dot(zero, n)), leg_.size));
  return {angle_range(g_.dot(crank, zero),
                      g_.quotient(g_.dot(crank, g_.cross(n, zero)), g_.root(leg_.size)),
                      g_.product(leg_.crank, g_.root(across)))};
}

/// An angle of (size·cos, size·sin) is at most half of the range away from its middle.
NodeId LegAtPose::angle_range(NodeId cosine, NodeId sine, NodeId size) {
  const auto [lo, hi] = *leg_.range;
  const NodeId two = g_.number(2);
  const NodeId middle = g_.quotient(g_.sum(lo, hi), two);
  const NodeId half = g_.quotient(g_.difference(hi, lo), two);
  const NodeId of_middle =
      g_.sum(g_.product(cosine, g_.cosine(middle)), g_.product(sine, g_.sine(middle)));
  return g_.difference(g_.product(size, g_.cosine(half)), of_middle);
}

NodeId LegAtPose::angle_to_platform(const VectorNodes& from, NodeId size) {
  const VectorNodes x = {R_[0][0], R_[1][0], R_[2][0]};
  return angle_range(g_.dot(from, x), g_.cross(from, x)[2], size);
}

}  // namespace regulus::verifier
