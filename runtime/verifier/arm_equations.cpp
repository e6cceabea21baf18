// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/arm_equations.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "runtime/verifier/algebra.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/middle_angle.hpp"
#include "runtime/verifier/moving_arm.hpp"
#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/rounding.hpp"
#include "runtime/verifier/trig_sums.hpp"
#include "runtime/verifier/variety.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfNumbers = 128;
constexpr std::uint64_t kProductsOfZero = 1 << 12;
constexpr double kParallel = 1e-12;  ///< axes whose squared sine is less

using Three = std::array<double, 3>;
double approx_dot(const Three& u, const Three& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

/// A line through P with the direction L, seen from a joint.
struct LineSums {
  TrigVector point, direction, moment;  ///< P, L, P × L
  TrigSum square, along;                ///< |P|², P·L
};

class ArmEquations {
 public:
  explicit ArmEquations(Question& q)
      : q_(q), a_(q.graph), places_(places_of(q)), arm_(read_moving_arm(q, places_)) {}

  [[nodiscard]] bool has_none() const { return arm_.is_turned_away; }

  /// The equations of all: the end's origin is at its place, and E = R(q)·R*ᵀ is symmetric. Returns its trace.
  NodeId form_all(const std::optional<JointPair>& left_out) {
    bound_slides();
    if (left_out) reaches_.erase(left_out->first), reaches_.erase(left_out->second);
    ClosureLines closure;
    std::vector<NodeId> values;
    for (std::size_t k = 0; k < arm_.free.size(); ++k) {
      values.push_back(unknown(k));
      closure.names.push_back("joint " + std::to_string(k + 1));
      const auto [middle, radius] = range_of(k);
      closure.middle.push_back(middle);
      closure.radius.push_back(radius);
    }
    const PlacementNodes end = arm_.end(a_, values);
    const VectorNodes gap = a_.difference(end.p, arm_.target.p);
    const MatrixNodes E = a_.product(end.R, a_.transposed(arm_.target.R));
    VectorNodes axial{};
    for (std::size_t i = 0; i < 3; ++i)
      axial[i] = a_.difference(E[(i + 2) % 3][(i + 1) % 3], E[(i + 1) % 3][(i + 2) % 3]);
    closure.equations = {gap.begin(), gap.end()};
    if (arm_.direction)
      closure.equations.push_back(a_.dot(*arm_.direction, axial));
    else
      closure.equations.insert(closure.equations.end(), axial.begin(), axial.end());
    q_.closure = std::move(closure);
    return a_.sum(a_.sum(E[0][0], E[1][1]), E[2][2]);
  }

  /// The equations without two joints, in the variables of the others.
  PostureSearch form_some(JointPair pair) {
    find_pair(pair);
    close_loop();
    const std::size_t free = arm_.free.size();
    std::vector<std::size_t> searched;
    for (std::size_t step = 1; step < free; ++step) {
      const std::size_t k = (pair_.second + step) % free;
      if (k != pair_.first) searched.push_back(k);
    }
    require_ranges(searched);
    ClosureLines closure;
    closure.equations = equations_without_pair(searched);
    std::vector<NodeId> also;
    if (free < kJointsOfArm) {  // both axes have the one direction: it is no condition
      const std::size_t other = arm_.free[pair_.first].slides ? 1 : 2;
      closure.equations = {closure.equations[0], closure.equations[other]};
    } else {
      also = {closure.equations.back()};
      closure.equations.pop_back();
    }
    for (const std::size_t k : searched) {
      closure.names.push_back(q_.closure->names[k]);
      closure.middle.push_back(q_.closure->middle[k]);
      closure.radius.push_back(q_.closure->radius[k]);
    }
    PostureSearch search{q_, std::move(searched), std::move(also)};
    search.question.closure = std::move(closure);
    return search;
  }

  /// Throws Rejection if a posture may be at a value that is not searched, or for a range that nothing needs.
  void require_ranges(const std::vector<std::size_t>& searched) const {
    for (std::size_t k = 0; k < arm_.free.size(); ++k)
      if (arm_.free[k].turns != 0 && arm_.free[k].lower != kNoNode)
        throw Rejection("joint " + std::to_string(k + 1) + " comes back, and needs no range");
    for (const std::size_t k : searched)
      if (arm_.free[k].turns == 0 && arm_.free[k].lower == kNoNode && !reaches_.contains(k))
        throw Rejection("joint " + std::to_string(k + 1) +
                        " is searched, and has neither turns that bring all back nor a range");
  }

 private:
  static std::vector<Ball> places_of(Question& q) {
    q.alpha = q.graph.number(Rational(0L));
    std::vector<Ball> places;
    for (const Interval place : enclose_variety(q).outer)
      places.emplace_back(place, kBitsOfNumbers);
    return places;
  }

  /// The unknown with a number.
  NodeId unknown(std::size_t number) {
    return q_.graph.add(Op::kVariable, int(q_.variables.size() + number));
  }

  /// Returns the middle and the radius.
  std::pair<NodeId, NodeId> range_of(std::size_t k) {
    const FreeJoint& joint = arm_.free[k];
    if (joint.lower != kNoNode)
      return {a_.quotient(a_.sum(joint.lower, joint.upper), a_.number(2)),
              a_.quotient(a_.difference(joint.upper, joint.lower), a_.number(2))};
    if (joint.turns == 0) return range_of_lines(k);
    return {middle_angle(q_.solutions->solutions, k, q_.graph),
            a_.product(a_.number(joint.turns), q_.graph.add(Op::kPi))};
  }

  /// The lines are in it. It is no part of the claim: the joint follows from the others, or is nowhere else.
  std::pair<NodeId, NodeId> range_of_lines(std::size_t k) {
    Interval all = point(0.0);
    if (const auto reach = reaches_.find(k); reach != reaches_.end())
      all = {-reach->second, reach->second};
    for (const SolutionLine& line : q_.solutions->solutions) all = hull(all, line.values[k]);
    if (!(mag(all) <= kLargest)) throw Rejection("the value of a slide is too large");
    const double radius = std::ldexp(1.0, 2 + std::ilogb(mag(all) + 1.0));
    return {a_.number(0), q_.graph.number(rational_of(radius))};
  }

  /// Slides one behind the other move the end by Σ s_k·g_k with fixed directions g_k, and not farther than the links
  /// are long together. With h_k·g_k = 1 and h_k·g_j = 0 for all others, |s_k| is at most so much times |h_k|.
  void bound_slides() {
    std::vector<std::size_t> slides;
    NodeId reach = length(arm_.target.p);
    for (std::size_t i = 0; i < arm_.joints.size(); ++i) {
      const MovingJoint& joint = arm_.joints[i];
      reach = a_.sum(reach, length(joint.before.p));
      if (!joint.slides) continue;
      if (!arm_.free[joint.leader].is_alone || (!slides.empty() && slides.back() + 1 != i)) return;
      slides.push_back(i);
    }
    if (slides.empty() || slides.size() > 3) return;
    std::vector<VectorNodes> g;
    MatrixNodes R = a_.identity();
    for (const std::size_t i : slides) {
      if (!g.empty()) R = a_.product(R, arm_.joints[i].before.R);
      g.push_back(a_.product(R, arm_.joints[i].axis));
    }
    for (std::size_t n = 0; n < g.size(); ++n) {
      const VectorNodes h = across_others(g, n);
      const auto most =
          evaluate(q_.graph, {a_.quotient(a_.product(reach, length(h)), a_.dot(h, g[n]))}, places_,
                   kBitsOfNumbers);
      if (most && is_bounded((*most)[0].enclosure()))
        reaches_[arm_.joints[slides[n]].leader] = mag((*most)[0].enclosure());
    }
  }

  NodeId length(const VectorNodes& v) { return a_.root(a_.dot(v, v)); }

  /// Returns a vector across all but one of up to three, which is in the space of all.
  VectorNodes across_others(const std::vector<VectorNodes>& g, std::size_t n) {
    if (g.size() == 1) return g[0];
    if (g.size() == 3) return a_.cross(g[(n + 1) % 3], g[(n + 2) % 3]);
    return a_.cross(a_.cross(g[0], g[1]), g[1 - n]);
  }

  // The loop J₁B₁J₂B₂…J_nB_n = 1, with the movement J_i of joint i.

  /// If a joint slides, it is the first of the pair.
  void find_pair(JointPair pair) {
    if (pair.first == pair.second || std::max(pair.first, pair.second) >= arm_.free.size())
      throw Rejection("the proof names no two joints that are free");
    if (arm_.free[pair.second].slides) std::swap(pair.first, pair.second);
    if (pair.are_opposite && !arm_.free[pair.first].slides &&
        std::ranges::any_of(arm_.free, &FreeJoint::slides))
      throw Rejection("the line 'opposite' is not about the joint that slides");
    for (const std::size_t k : {pair.first, pair.second}) {
      const std::string name = "joint " + std::to_string(k + 1);
      const FreeJoint& joint = arm_.free[k];
      if (!joint.is_alone) throw Rejection("another joint follows " + name);
      if (joint.lower != kNoNode) throw Rejection(name + " has a range, and is not searched");
      if (k == pair.second && joint.slides) throw Rejection("both joints that are left out slide");
    }
    pair_ = pair;
    first_ = number_of(pair.first);
    second_ = number_of(pair.second);
  }

  /// Returns the number, among all that move, of a free joint that nothing follows.
  std::size_t number_of(std::size_t free) const {
    return std::size_t(std::ranges::find(arm_.joints, free, &MovingJoint::leader) -
                       arm_.joints.begin());
  }

  /// O₁J₁…O_nJ_n = T is J₁O₂J₂…O_nJ_n(T⁻¹O₁) = 1.
  void close_loop() {
    const std::size_t n = arm_.joints.size();
    for (const MovingJoint& joint : arm_.joints) behind_.push_back(joint.before);
    std::rotate(behind_.begin(), behind_.begin() + 1, behind_.end());
    behind_.back() = a_.product(a_.inverse(arm_.target), behind_.back());
    for (std::size_t i = 1; i <= n; ++i) move_origin(i % n);
  }

  /// A shift along its axis does not change a joint. It brings the origin near the axis before, where
  /// more coefficients are small.
  void move_origin(std::size_t joint) {
    const std::size_t n = behind_.size(), last = (joint + n - 1) % n;
    PlacementNodes &before = behind_[last], &behind = behind_[joint];
    const VectorNodes& axis = arm_.joints[joint].axis;
    const Three b = approx(arm_.joints[last].axis), a = approx(a_.product(before.R, axis)),
                d = approx(before.p);
    const double ab = approx_dot(a, b), across = 1 - ab * ab;
    const double shift = across < kParallel ? -approx_dot(d, a)
                                            : (ab * approx_dot(d, b) - approx_dot(d, a)) / across;
    if (!std::isfinite(shift)) return;
    const VectorNodes along = a_.scaled(q_.graph.number(rational_of(shift)), axis);
    before.p = a_.sum(before.p, a_.product(before.R, along));
    behind.p = a_.difference(behind.p, along);
  }

  Three approx(const VectorNodes& v) {
    const auto values = evaluate(q_.graph, {v[0], v[1], v[2]}, places_, kBitsOfNumbers);
    if (!values) throw Unfinished("a number of the arm has no certain value");
    return {mid((*values)[0].enclosure()), mid((*values)[1].enclosure()),
            mid((*values)[2].enclosure())};
  }

  // The equations, as PROOF.md derives them. `s`: sums by the unknowns that are searched.

  LineSums axis_of_second(TrigSums& s) const {
    LineSums line;
    line.direction = s.constant(arm_.joints[second_].axis);
    return line;
  }

  /// A point x becomes Rx + d.
  void move(TrigSums& s, LineSums& line, const PlacementNodes& frame) {
    line.point = s.product(frame.R, line.point);
    line.direction = s.product(frame.R, line.direction);
    line.moment = s.sum(s.product(frame.R, line.moment), s.cross(frame.p, line.direction));
    line.square = s.sum(s.sum(line.square, s.dot(frame.p, line.point), 2),
                        s.constant(a_.dot(frame.p, frame.p)));
    line.along = s.sum(line.along, s.dot(frame.p, line.direction));
    line.point = s.sum(line.point, s.constant(frame.p));
  }

  /// A point x becomes Rᵀ(x − d).
  void move_back(TrigSums& s, LineSums& line, const PlacementNodes& frame) {
    const MatrixNodes back = a_.transposed(frame.R);
    line.square = s.sum(s.sum(line.square, s.dot(frame.p, line.point), -2),
                        s.constant(a_.dot(frame.p, frame.p)));
    line.along = s.sum(line.along, s.dot(frame.p, line.direction), -1);
    line.moment = s.product(back, s.sum(line.moment, s.cross(frame.p, line.direction), -1));
    line.point = s.product(back, s.sum(line.point, s.constant(frame.p), -1));
    line.direction = s.product(back, line.direction);
  }

  /// Applies the movement of a joint, or with the sign −1 that back.
  void pass(TrigSums& s, LineSums& line, std::size_t number, long sign,
            const std::vector<std::size_t>& searched) {
    const MovingJoint& joint = arm_.joints[number];
    const auto x = std::size_t(std::ranges::find(searched, joint.leader) - searched.begin());
    if (!joint.slides) {
      for (TrigVector* part : {&line.point, &line.direction, &line.moment})
        *part = s.turned(*part, joint.axis, x, joint.factor, sign);
      return;
    }
    // P becomes P + x·v.
    const VectorNodes v = a_.scaled(a_.product(a_.number(sign), joint.factor), joint.axis);
    line.square = s.sum(s.sum(line.square, s.times_unknown(s.dot(v, line.point), x), 2),
                        s.times_unknown(s.times_unknown(s.constant(a_.dot(v, v)), x), x));
    line.along = s.sum(line.along, s.times_unknown(s.dot(v, line.direction), x));
    line.moment = s.sum(line.moment, s.times_unknown(s.cross(v, line.direction), x));
    line.point = s.sum(line.point, s.times_unknown(s.constant(v), x));
  }

  std::vector<NodeId> equations_without_pair(const std::vector<std::size_t>& searched) {
    TrigSums s(q_.graph, searched.size());
    const std::size_t n = arm_.joints.size();
    LineSums between = axis_of_second(s), around = between;
    for (std::size_t i = (second_ + n - 1) % n;; i = (i + n - 1) % n) {
      move(s, between, behind_[i]);
      if (i == first_) break;
      pass(s, between, i, 1, searched);
    }
    for (std::size_t i = second_;;) {
      move_back(s, around, behind_[i]);
      i = (i + 1) % n;
      if (i == first_) break;
      pass(s, around, i, -1, searched);
    }
    std::vector<NodeId> unknowns;
    for (std::size_t k = 0; k < searched.size(); ++k) unknowns.push_back(unknown(k));
    std::vector<NodeId> equations;
    for (TrigSum& gap : gaps(s, around, between)) {
      std::erase_if(gap, [this](const auto& term) { return is_zero(term.second); });
      equations.push_back(s.expression(gap, unknowns));
    }
    return equations;
  }

  /// A rotation about k changes none of these, and a shift along k none of the others. The last one is no equation of
  /// the search.
  std::vector<TrigSum> gaps(TrigSums& s, const LineSums& around, const LineSums& between) {
    const VectorNodes& k = arm_.joints[first_].axis;
    const auto gap = [&](const VectorNodes& by, TrigVector LineSums::*part) {
      return s.sum(s.dot(by, around.*part), s.dot(by, between.*part), -1);
    };
    if (!arm_.joints[first_].slides)
      return {gap(k, &LineSums::point), gap(k, &LineSums::direction),
              s.sum(around.square, between.square, -1), s.sum(around.along, between.along, -1),
              gap(k, &LineSums::moment)};
    const Three near = approx(k);
    std::size_t least = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (std::fabs(near[i]) < std::fabs(near[least])) least = i;
    VectorNodes unit = a_.zero();
    unit[least] = a_.number(1);
    const VectorNodes e = a_.cross(k, unit), f = a_.cross(k, e);
    return {gap(e, &LineSums::point), gap(f, &LineSums::point), gap(e, &LineSums::direction),
            gap(f, &LineSums::direction), gap(k, &LineSums::direction)};
  }

  /// Shows that a coefficient is 0. Where a follower turns back what its leader turns, many are.
  bool is_zero(NodeId coefficient) {
    const auto value = evaluate(q_.graph, {coefficient}, places_, kBitsOfNumbers);
    return value && arb_contains_zero((*value)[0].get()) != 0 &&
           certain_equal(q_.graph, coefficient, a_.number(0), kProductsOfZero);
  }

  Question& q_;
  GraphAlgebra a_;
  const std::vector<Ball> places_;  ///< of the uncertain quantities
  const MovingArm arm_;
  std::map<std::size_t, double> reaches_{};  ///< of free joints that slide
  JointPair pair_{};                         ///< free joints
  std::size_t first_ = 0, second_ = 0;       ///< the same, as joints that move
  std::vector<PlacementNodes> behind_;       ///< B_i
};

}  // namespace

PostureSearch form_posture_equations(Question& question, std::optional<JointPair> left_out) {
  ArmEquations equations(question);
  const NodeId trace = equations.form_all(left_out);
  PostureSearch search{question};
  if (left_out) {
    search = equations.form_some(*left_out);
  } else {
    for (std::size_t k = 0; k < question.closure->names.size(); ++k) search.searched.push_back(k);
    if (!equations.has_none()) equations.require_ranges(search.searched);
    GraphAlgebra algebra(search.question.graph);
    search.also = {algebra.difference(trace, algebra.number(3))};
  }
  search.trace = trace;
  search.has_none = equations.has_none();
  return search;
}

}  // namespace regulus::verifier
