// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/body_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

bool is_free(const ImportedJoint& joint) {
  return joint.type_name == "free" || joint.type_name == "floating";
}

ConnectionKind kind_of(const ImportedJoint& joint) {
  if (joint.type == JointType::kPrismatic) return ConnectionKind::kPrismatic;
  if (turns(joint)) return ConnectionKind::kRevolute;
  if (joint.type_name == "universal") return ConnectionKind::kUniversal;
  return joint.type_name == "ball" ? ConnectionKind::kBall : ConnectionKind::kOther;
}

Point moved(const Placement& frame, const Point& x) {
  return reduced(sum(times(frame.R, x), frame.p));
}

/// The distance of two points; 0 within a file's rounding.
double gap_between(const Point& a, const Point& b) {
  constexpr double kRounding = 1e-6;
  std::array<double, 3> d{};
  for (std::size_t i = 0; i < 3; ++i) d.at(i) = number_of(reduced(a[i] - b[i])).approx();
  const double gap = std::hypot(d[0], d[1], d[2]);
  return gap > kRounding ? gap : 0;
}

Point exact(const std::array<WrittenNumber, 3>& v) { return {v[0].value, v[1].value, v[2].value}; }

}  // namespace

void require_independent(const Connection& connection, const std::string& file) {
  if (!connection.mimics) return;
  throw InputError::statement(
      file, connection.line,
      fmt::format("joint {} of a leg follows joint {} (mimic)", in_quotes(connection.name),
                  in_quotes(*connection.mimics)),
      "the joints of legs move as the loops let them; write the equations of this robot as a "
      "[closure]");
}

BodyGraph::BodyGraph(const Mechanism& mechanism) {
  place_links(mechanism);
  unite_links(mechanism);
  connect(mechanism);
}

/// From links without a parent along the joints, every joint at zero.
void BodyGraph::place_links(const Mechanism& mechanism) {
  std::map<std::string, std::vector<const ImportedJoint*>> behind;
  std::map<std::string, int> parents;
  for (const ImportedJoint& joint : mechanism.joints) {
    behind[joint.parent].push_back(&joint);
    ++parents[joint.child];
  }
  std::vector<std::string> open;
  for (const std::string& link : mechanism.links)
    if (!parents.contains(link)) {
      placements_.emplace(link, Placement{});
      open.push_back(link);
    }
  while (!open.empty()) {
    const std::string link = open.back();
    open.pop_back();
    for (const ImportedJoint* joint : behind[link]) {
      const Placement frame = compose(placements_.at(link), placement_of(joint->origin));
      if (placements_.emplace(joint->child, frame).second) open.push_back(joint->child);
    }
  }
  // A cycle of joints without a root.
  for (const std::string& link : mechanism.links) placements_.emplace(link, Placement{});
}

void BodyGraph::unite_links(const Mechanism& mechanism) {
  std::map<std::string, std::vector<std::string>> fixed;
  for (const ImportedJoint& joint : mechanism.joints)
    if (joint.type == JointType::kFixed) {
      fixed[joint.parent].push_back(joint.child);
      fixed[joint.child].push_back(joint.parent);
    }
  for (const std::string& first : mechanism.links) {
    if (body_.contains(first)) continue;
    const std::size_t body = links_.size();
    links_.push_back(first);
    std::vector<std::string> open = {first};
    while (!open.empty()) {
      const std::string link = open.back();
      open.pop_back();
      if (!body_.emplace(link, body).second) continue;
      for (const std::string& other : fixed[link]) open.push_back(other);
    }
  }
}

void BodyGraph::connect(const Mechanism& mechanism) {
  for (const ImportedJoint& joint : mechanism.joints) {
    if (joint.type == JointType::kFixed || is_free(joint)) continue;
    const Placement frame = compose(placements_.at(joint.parent), placement_of(joint.origin));
    connections_.push_back(
        {joint.name, kind_of(joint), body_.at(joint.parent), body_.at(joint.child), frame.p,
         reduced(times(frame.R, exact(joint.axis))), joint.line, 0, joint.mimics});
  }
  for (const ImportedLoop& loop : mechanism.loops) {
    const Point point = moved(placements_.at(loop.first), exact(loop.anchor));
    const double gap = loop.origins_meet ? gap_between(point, placements_.at(loop.second).p) : 0;
    connections_.push_back({loop.type,
                            loop.type == "connect" ? ConnectionKind::kBall : ConnectionKind::kOther,
                            body_.at(loop.first),
                            body_.at(loop.second),
                            point,
                            {},
                            loop.line,
                            gap,
                            {}});
  }
}

std::vector<std::size_t> BodyGraph::of_body(std::size_t body) const {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < connections_.size(); ++i)
    if ((connections_[i].first == body) != (connections_[i].second == body)) result.push_back(i);
  return result;
}

}  // namespace regulus::detail
