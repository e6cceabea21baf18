// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/loop_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <set>

#include "codegen/model/exact/exact_algebra.hpp"
#include "codegen/model/import/body_graph.hpp"
#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using Steps = std::vector<LoopStep>;

double double_of(const ex& e) { return WrittenNumber{e, ""}.approx(); }

bool is_ball(const ImportedJoint& joint) {
  return joint.type_name == "ball" || joint.type_name == "spherical";
}

/// Coordinate axes after one another: the product of two such frames is as simple as they are.
bool is_plain(const Placement& frame) {
  int zeros = 0;
  for (unsigned i = 0; i < 9; ++i) zeros += frame.R(i / 3, i % 3).is_zero() ? 1 : 0;
  return zeros == 6;
}

Point unit(const std::array<WrittenNumber, 3>& axis) {
  Point a;
  ex square = 0;
  for (std::size_t i = 0; i < 3; ++i) a[i] = axis[i].value, square += pow(a[i], 2);
  return reduced(scaled(1 / reduced(sqrt(square)), a));
}

/// A joint that is passed, in which direction.
struct Edge {
  const ImportedJoint* joint = nullptr;
  bool reversed = false;

  [[nodiscard]] const std::string& from() const { return reversed ? joint->child : joint->parent; }
};

class LoopFinder {
 public:
  LoopFinder(const Mechanism& mechanism, const std::string& file)
      : mechanism_(mechanism), file_(file) {}

  LoopGraph find() {
    grow_trees();
    for (const ImportedJoint* joint : closing_) close_by_joint(*joint);
    std::set<const ImportedLoop*> closed;
    for (const ImportedLoop& loop : mechanism_.loops) {
      if (!closed.insert(&loop).second) continue;
      const ImportedLoop* const other = second_point_of(loop);
      if (other != nullptr && closed.insert(other).second)
        close_by_hinge(loop, *other);
      else
        close(loop);
    }
    return std::move(graph_);
  }

 private:
  [[noreturn]] void refuse(int line, const std::string& problem, const std::string& remedy) const {
    throw InputError::statement(file_, line, problem, remedy);
  }

  /// Reaches each link from a root; joints that are not needed for it close loops.
  void grow_trees() {
    std::map<std::string, std::vector<Edge>> edges;
    std::map<std::string, int> parents;
    for (const ImportedJoint& joint : mechanism_.joints) {
      edges[joint.parent].push_back({&joint, false});
      edges[joint.child].push_back({&joint, true});
      ++parents[joint.child];
    }
    std::vector<std::string> roots;
    for (const std::string& link : mechanism_.links)
      if (!parents.contains(link)) roots.push_back(link);
    roots.insert(roots.end(), mechanism_.links.begin(), mechanism_.links.end());
    std::map<const ImportedJoint*, bool> used;
    for (const std::string& root : roots) {
      if (!up_.emplace(root, Edge{}).second) continue;
      // The file's own tree is kept, because joints lead to their children first.
      std::deque<std::string> open{root};
      while (!open.empty()) {
        const std::string link = open.front();
        open.pop_front();
        for (const Edge& edge : edges[link]) {
          const std::string& next = edge.reversed ? edge.joint->parent : edge.joint->child;
          if (!up_.emplace(next, edge).second) continue;
          used[edge.joint] = true;
          open.push_back(next);
        }
      }
    }
    for (const ImportedJoint& joint : mechanism_.joints)
      if (!used.contains(&joint)) closing_.push_back(&joint);
  }

  std::vector<Edge> path(std::string link) const {
    std::vector<Edge> edges;
    for (Edge edge = up_.at(link); edge.joint != nullptr; edge = up_.at(link)) {
      edges.push_back(edge);
      link = edge.from();
    }
    std::ranges::reverse(edges);
    return edges;
  }

  const std::string& root_of(const std::string& link, const std::vector<Edge>& path) const {
    return path.empty() ? link : path.front().from();
  }

  void close_by_joint(const ImportedJoint& joint) {
    add({in_quotes(joint.name), joint.line, {}, 0}, joint.parent, steps_of({&joint, false}),
        joint.child);
  }

  static bool is_closed_point(const ImportedLoop& loop) {
    return loop.type == "connect" && !loop.origins_meet;
  }

  /// The point in the world with every joint at zero.
  Point place_of(const ImportedLoop& loop) {
    Placement anchor;
    for (std::size_t i = 0; i < 3; ++i) anchor.p[i] = loop.anchor[i].value;
    return compose(zero().placement(loop.first), anchor).p;
  }

  /// Another point that holds the same links together where the loop is closed; nullptr without one.
  const ImportedLoop* second_point_of(const ImportedLoop& loop) {
    if (!is_closed_point(loop)) return nullptr;
    for (const ImportedLoop& other : mechanism_.loops) {
      const bool is_same_pair =
          std::minmax(loop.first, loop.second) == std::minmax(other.first, other.second);
      if (&other != &loop && is_closed_point(other) && is_same_pair) return &other;
    }
    return nullptr;
  }

  /// Points that hold the same two links leave them a turn about the line through both.
  void close_by_hinge(const ImportedLoop& loop, const ImportedLoop& other) {
    const Point at = place_of(loop), behind = place_of(other);
    const Point apart =
        reduced(transposed_times(zero().placement(loop.first).R,
                                 Point{behind[0] - at[0], behind[1] - at[1], behind[2] - at[2]}));
    if (std::ranges::all_of(apart, [](const ex& x) { return is_certainly_zero(x); }))
      return close(loop);  // it is there twice
    ImportedJoint& hinge = made_.emplace_back();
    hinge.name = fmt::format("{} of {} and {}", loop.type, loop.first, loop.second);
    hinge.type = JointType::kContinuous;
    hinge.line = loop.line;
    for (std::size_t i = 0; i < 3; ++i) hinge.axis[i] = number_of(apart[i]);
    hinge.origin.xyz = loop.anchor;
    Placement anchor;
    for (std::size_t i = 0; i < 3; ++i) anchor.p[i] = loop.anchor[i].value;
    Steps between = steps_of({&hinge, false});
    between.push_back(fixed_step(inverse(in_second(loop, anchor))));
    add({hinge.name, loop.line, {}, 0}, loop.first, std::move(between), loop.second);
  }

  /// A frame of the first link, seen from the second with every joint at zero.
  Placement in_second(const ImportedLoop& loop, const Placement& of_first) {
    return compose(inverse(zero().placement(loop.second)),
                   compose(zero().placement(loop.first), of_first));
  }

  void close(const ImportedLoop& loop) {
    const std::string name =
        fmt::format("{} of {} and {}", loop.type, in_quotes(loop.first), in_quotes(loop.second));
    Placement first, second;
    for (std::size_t i = 0; i < 3; ++i) first.p[i] = loop.anchor[i].value;
    if (loop.relative)
      first = placement_of(*loop.relative);
    else if (!loop.origins_meet)
      second = in_second(loop, first);
    Steps between{fixed_step(first)};
    if (loop.type == "connect") {
      LoopStep ball;
      ball.kind = LoopStep::Kind::kBall;
      ball.name = name;
      between.push_back(std::move(ball));
    }
    between.push_back(fixed_step(inverse(second)));
    add({name, loop.line, {}, 0}, loop.first, std::move(between), loop.second);
  }

  const BodyGraph& zero() {
    if (!zero_) zero_.emplace(mechanism_);
    return *zero_;
  }

  /// Adds the loop that leads to `first`, by the steps to `second`, and back.
  void add(Loop loop, const std::string& first, Steps between, const std::string& second) {
    const std::vector<Edge> to = path(first), back = path(second);
    if (root_of(first, to) != root_of(second, back))
      refuse(loop.line, fmt::format("{} ties links that no joint connects otherwise", loop.name),
             "give one of the links a joint to the rest of the robot");
    const auto apart = std::ranges::mismatch(
        to, back, [](const Edge& a, const Edge& b) { return a.joint == b.joint; });
    Steps there, home;
    for (auto edge = apart.in1; edge != to.end(); ++edge) append(there, steps_of(*edge));
    for (auto edge = apart.in2; edge != back.end(); ++edge) append(home, steps_of(*edge));
    loop.closes_at = there.size();
    append(there, between);
    append(there, reversed(home));
    loop.steps = std::move(there);
    if (std::ranges::any_of(loop.steps,
                            [](const LoopStep& s) { return s.kind != LoopStep::Kind::kFixed; }))
      graph_.loops.push_back(std::move(loop));
    else
      require_closed(loop);
  }

  /// A loop without a joint holds nothing, but it must be true.
  void require_closed(const Loop& loop) const {
    constexpr double kRounding = 1e-6;
    Placement around;
    for (const LoopStep& step : loop.steps) around = compose(around, step.frame);
    const LoopStep whole = fixed_step(around);
    for (std::size_t i = 0; i < whole.approx.size(); ++i)
      if (std::fabs(whole.approx[i] - (i % 4 == 0 && i < 9 ? 1 : 0)) > kRounding)
        refuse(loop.line, fmt::format("{} ties frames of one body that are apart", loop.name),
               "correct the frames, or leave the loop out");
  }

  /// Fixed steps after one another become one where it is simple.
  static void append(Steps& to, const Steps& steps) {
    for (const LoopStep& step : steps) {
      const bool joins = !to.empty() && step.kind == LoopStep::Kind::kFixed &&
                         to.back().kind == LoopStep::Kind::kFixed &&
                         (is_plain(step.frame) || is_plain(to.back().frame));
      if (joins)
        to.back() = fixed_step(compose(to.back().frame, step.frame));
      else
        to.push_back(step);
    }
  }

  Steps steps_of(const Edge& edge) {
    const ImportedJoint& joint = *edge.joint;
    Steps steps{fixed_step(placement_of(joint.origin))};
    if (joint.type != JointType::kFixed) {
      LoopStep moves;
      moves.kind = is_ball(joint) ? LoopStep::Kind::kBall : LoopStep::Kind::kJoint;
      moves.name = in_quotes(joint.name);
      if (!is_ball(joint)) moves.joint = index_of(joint);
      steps.push_back(std::move(moves));
    }
    return edge.reversed ? reversed(steps) : steps;
  }

  std::size_t index_of(const ImportedJoint& joint) {
    if (const auto known = joints_.find(&joint); known != joints_.end()) return known->second;
    if (joint.type == JointType::kOther)
      refuse(joint.line,
             fmt::format("joint {} of a loop has the type {}", in_quotes(joint.name),
                         in_quotes(joint.type_name)),
             "loops have joints that turn or slide, balls and fixed joints");
    LoopJoint made;
    made.name = joint.name;
    made.slides = joint.type == JointType::kPrismatic;
    made.axis = unit(joint.axis);
    for (std::size_t i = 0; i < 3; ++i) made.approx_axis[i] = double_of(made.axis[i]);
    const ImportedJoint& leader = leader_of(joint);
    if (&leader != &joint) follow(made, joint);
    made.variable = variable_of(leader);
    graph_.joints.push_back(std::move(made));
    return joints_[&joint] = graph_.joints.size() - 1;
  }

  const ImportedJoint& leader_of(const ImportedJoint& joint) const {
    if (!joint.mimics) return joint;
    const auto leader = std::ranges::find(mechanism_.joints, *joint.mimics, &ImportedJoint::name);
    if (leader == mechanism_.joints.end() || leader->mimics || !joint.rule ||
        leader->type == JointType::kFixed || leader->type == JointType::kOther)
      refuse(joint.line,
             fmt::format("joint {} of a loop follows joint {} (mimic)", in_quotes(joint.name),
                         in_quotes(*joint.mimics)),
             "only a joint that follows none may be followed, with a multiplier and an offset");
    return *leader;
  }

  static void follow(LoopJoint& made, const ImportedJoint& joint) {
    made.follows = true;
    made.multiplier = joint.rule->multiplier.value;
    made.offset = joint.rule->offset.value;
    made.approx_multiplier = joint.rule->multiplier.approx();
    made.approx_offset = joint.rule->offset.approx();
  }

  std::size_t variable_of(const ImportedJoint& joint) {
    if (const auto known = variables_.find(&joint); known != variables_.end()) return known->second;
    std::vector<const ImportedJoint*> followers;
    for (const ImportedJoint& other : mechanism_.joints)
      if (other.mimics == joint.name && other.rule) followers.push_back(&other);
    graph_.variables.push_back({joint.name, joint.type == JointType::kPrismatic, joint.line,
                                limits_of(joint, followers, file_)});
    return variables_[&joint] = graph_.variables.size() - 1;
  }

  const Mechanism& mechanism_;
  const std::string& file_;
  std::optional<BodyGraph> zero_;     ///< every joint at zero
  std::deque<ImportedJoint> made_{};  ///< that the file has as two points
  std::map<std::string, Edge> up_;
  std::vector<const ImportedJoint*> closing_;
  std::map<const ImportedJoint*, std::size_t> joints_, variables_;  ///< in the graph
  LoopGraph graph_;
};

}  // namespace

LoopStep fixed_step(const Placement& frame) {
  LoopStep step;
  step.frame = frame;
  for (unsigned i = 0; i < 3; ++i) {
    for (unsigned j = 0; j < 3; ++j) step.approx[i * 3 + j] = double_of(frame.R(i, j));
    step.approx[9 + i] = double_of(frame.p[i]);
  }
  return step;
}

std::vector<LoopStep> reversed(const std::vector<LoopStep>& steps) {
  Steps back;
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    back.push_back(step->kind == LoopStep::Kind::kFixed ? fixed_step(inverse(step->frame)) : *step);
    back.back().reversed = !step->reversed;
  }
  return back;
}

LoopGraph find_loops(const Mechanism& mechanism, const std::string& file) {
  return LoopFinder(mechanism, file).find();
}

}  // namespace regulus::detail
