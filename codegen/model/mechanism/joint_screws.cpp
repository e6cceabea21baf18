// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/joint_screws.hpp"

#include <optional>

namespace regulus::detail {
namespace {

using GiNaC::ex;

PolynomialVector zero_vector(const JointGroups& groups) {
  return {JointPolynomial(groups), JointPolynomial(groups), JointPolynomial(groups)};
}

PolynomialVector constant_vector(const JointGroups& groups, const Point& v) {
  return {JointPolynomial(groups, v[0]), JointPolynomial(groups, v[1]),
          JointPolynomial(groups, v[2])};
}

/// Adds factor · R·v, with R 3×3 of constants.
void add_product(PolynomialVector& result, const GiNaC::matrix& R, const PolynomialVector& v,
                 const ex& factor = 1) {
  for (unsigned i = 0; i < 3; ++i)
    for (unsigned j = 0; j < 3; ++j) result[i].add(v[j], factor * R(i, j));
}

/// The matrix of v ↦ u × v.
GiNaC::matrix cross_matrix(const Point& u) {
  return {{0, -u[2], u[1]}, {u[2], 0, -u[0]}, {-u[1], u[0], 0}};
}

PolynomialVector times_cosine(const PolynomialVector& v, std::size_t joint) {
  return {v[0].times_cosine(joint), v[1].times_cosine(joint), v[2].times_cosine(joint)};
}

PolynomialVector times_sine(const PolynomialVector& v, std::size_t joint) {
  return {v[0].times_sine(joint), v[1].times_sine(joint), v[2].times_sine(joint)};
}

PolynomialVector times_displacement(const PolynomialVector& v, std::size_t joint) {
  return {v[0].times_displacement(joint), v[1].times_displacement(joint),
          v[2].times_displacement(joint)};
}

/// Screws on their way from frame to frame.
class ScrewTransport {
 public:
  ScrewTransport(const Serial& robot, const JointGroups& groups) : robot_(robot), groups_(groups) {}

  /// Returns the screw of a joint in its own frame.
  JointScrew own(std::size_t joint) const {
    const SerialJoint& j = robot_.joints[joint];
    const PolynomialVector axis = constant_vector(groups_, j.axis), none = zero_vector(groups_);
    return j.kind == JointKind::kRevolute ? JointScrew{none, axis} : JointScrew{axis, none};
  }

  /// From the frame that a joint moves to the frame in which it is placed.
  JointScrew towards_base(const JointScrew& screw, std::size_t joint, bool moved) const {
    JointScrew s = moved ? motion(screw, joint, 1) : screw;
    const Placement& origin = robot_.joints[joint].origin;
    JointScrew result{zero_vector(groups_), zero_vector(groups_)};
    add_product(result.velocity, origin.R, s.velocity);
    add_product(result.spin, origin.R, s.spin);
    add_product(result.velocity, cross_matrix(origin.p), result.spin);
    return result;
  }

  /// The way back.
  JointScrew towards_tool(const JointScrew& screw, std::size_t joint) const {
    const Placement& origin = robot_.joints[joint].origin;
    PolynomialVector velocity = screw.velocity;
    add_product(velocity, cross_matrix(origin.p), screw.spin, -1);
    const GiNaC::matrix back = origin.R.transpose();
    JointScrew result{zero_vector(groups_), zero_vector(groups_)};
    add_product(result.velocity, back, velocity);
    add_product(result.spin, back, screw.spin);
    return motion(result, joint, -1);
  }

 private:
  /// The motion of a joint by +q or −q.
  JointScrew motion(const JointScrew& screw, std::size_t joint, int sign) const {
    const SerialJoint& j = robot_.joints[joint];
    if (j.kind == JointKind::kRevolute)
      return {turned(screw.velocity, joint, sign), turned(screw.spin, joint, sign)};
    JointScrew result = screw;
    add_product(result.velocity, cross_matrix(j.axis), times_displacement(screw.spin, joint), sign);
    return result;
  }

  /// a(a·v) + cos q (v − a(a·v)) ± sin q a × v, a the axis.
  PolynomialVector turned(const PolynomialVector& v, std::size_t joint, int sign) const {
    const Point& a = robot_.joints[joint].axis;
    const GiNaC::matrix along = {{a[0] * a[0], a[0] * a[1], a[0] * a[2]},
                                 {a[1] * a[0], a[1] * a[1], a[1] * a[2]},
                                 {a[2] * a[0], a[2] * a[1], a[2] * a[2]}};
    PolynomialVector result = zero_vector(groups_), across = v, normal = zero_vector(groups_);
    add_product(result, along, v);
    add_product(across, along, v, -1);
    add_product(normal, cross_matrix(a), v);
    const PolynomialVector cosine = times_cosine(across, joint), sine = times_sine(normal, joint);
    for (std::size_t i = 0; i < 3; ++i) {
      result[i].add(cosine[i], 1);
      result[i].add(sine[i], sign);
    }
    return result;
  }

  const Serial& robot_;
  const JointGroups& groups_;
};

/// The point where the axes of two successive joints meet, in the frame of the link between them
/// and in that of the link behind.
struct Meeting {
  Point before, after;
};

/// Axes a through 0 and b through p, b turning with the frame behind.
std::optional<Meeting> meeting(const SerialJoint& first, const SerialJoint& second) {
  if (first.kind != JointKind::kRevolute || second.kind != JointKind::kRevolute)
    return std::nullopt;
  const Point &a = first.axis, &p = second.origin.p;
  const Point b = reduced(times(second.origin.R, second.axis));
  const Point normal = reduced(cross(a, b));
  const ex square = reduced(dot(normal, normal));
  if (!is_certainly_nonzero(square) || !is_certainly_zero(dot(p, normal))) return std::nullopt;
  const ex along_a = reduced(dot(cross(p, b), normal) / square);
  const ex along_b = reduced(dot(cross(p, a), normal) / square);
  return Meeting{reduced(scaled(along_a, a)), reduced(scaled(along_b, second.axis))};
}

void add_unless_known(std::vector<Point>& all, Point candidate) {
  for (const Point& known : all)
    if (is_certainly_zero(known[0] - candidate[0]) && is_certainly_zero(known[1] - candidate[1]) &&
        is_certainly_zero(known[2] - candidate[2]))
      return;
  all.push_back(std::move(candidate));
}

Point placed(const Placement& origin, const Point& x) {
  return reduced(sum(times(origin.R, x), origin.p));
}

}  // namespace

JointGroups parallel_groups(const Serial& robot, std::shared_ptr<TermBudget> budget) {
  JointGroups groups;
  groups.budget = std::move(budget);
  std::optional<Point> axis;  // of the last joint that turns, in the frame that is reached
  for (const SerialJoint& j : robot.joints) {
    if (axis) axis = reduced(transposed_times(j.origin.R, *axis));
    if (j.kind != JointKind::kRevolute) {
      groups.of_joint.push_back(JointGroups::kNone);
      continue;
    }
    bool parallel = axis.has_value();
    if (axis)
      for (const ex& component : cross(*axis, j.axis))
        parallel = parallel && is_certainly_zero(component);
    if (!parallel) ++groups.count;
    groups.of_joint.push_back(groups.count - 1);
    axis = j.axis;
  }
  return groups;
}

JointGroups single_groups(const Serial& robot, std::shared_ptr<TermBudget> budget) {
  JointGroups groups;
  groups.budget = std::move(budget);
  for (const SerialJoint& j : robot.joints)
    groups.of_joint.push_back(j.kind == JointKind::kRevolute ? groups.count++ : JointGroups::kNone);
  return groups;
}

std::vector<Point> reference_points(const Serial& robot, std::size_t link) {
  std::vector<Point> all;
  const auto& joints = robot.joints;
  if (link > 0) add_unless_known(all, {0, 0, 0});
  if (link > 1)
    if (const auto m = meeting(joints[link - 2], joints[link - 1])) add_unless_known(all, m->after);
  if (link == joints.size()) return all;
  add_unless_known(all, joints[link].origin.p);
  if (link > 0)
    if (const auto m = meeting(joints[link - 1], joints[link])) add_unless_known(all, m->before);
  if (link + 1 < joints.size())
    if (const auto m = meeting(joints[link], joints[link + 1]))
      add_unless_known(all, placed(joints[link].origin, m->before));
  return all;
}

std::vector<JointScrew> joint_screws(const Serial& robot, const JointGroups& groups,
                                     std::size_t link) {
  const ScrewTransport transport(robot, groups);
  std::vector<JointScrew> screws;
  for (std::size_t joint = 0; joint < robot.joints.size(); ++joint) {
    JointScrew screw = transport.own(joint);
    // Its own motion does not change it.
    for (std::size_t k = joint + 1; k-- > link;)
      screw = transport.towards_base(screw, k, k != joint);
    for (std::size_t k = joint + 1; k < link; ++k) screw = transport.towards_tool(screw, k);
    screws.push_back(std::move(screw));
  }
  return screws;
}

std::vector<JointScrew> moved_to(std::vector<JointScrew> screws, const Point& point) {
  for (JointScrew& screw : screws) add_product(screw.velocity, cross_matrix(point), screw.spin, -1);
  return screws;
}

}  // namespace regulus::detail
