// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/arm_equations.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "runtime/verifier/algebra.hpp"
#include "runtime/verifier/bilinear_forms.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/middle_angle.hpp"
#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/rounding.hpp"
#include "runtime/verifier/variety.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfNumbers = 128;
constexpr std::uint64_t kProductsOfFrame = 1 << 16;
constexpr double kParallel = 1e-12;  ///< axes whose squared sine is less
constexpr std::array<std::size_t, 4> kSearched = {0, 1, 3, 4};

using Three = std::array<double, 3>;
double approx_dot(const Three& u, const Three& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

/// J₁B₁J₂B₂…J₆B₆ = 1 with the rotation J_i about axis i through the origin.
struct Loop {
  std::array<VectorNodes, kJointsOfArm> axis;
  std::array<PlacementNodes, kJointsOfArm> behind;  ///< B_i
};

class ArmEquations : private BilinearForms {
 public:
  ArmEquations(Question& q, std::size_t pair)
      : BilinearForms(q.graph), q_(q), arm_(*q.solutions->arm), first_(pair) {
    q_.alpha = a_.number(0);
    for (const Interval place : enclose_variety(q_).outer)
      places_.emplace_back(place, kBitsOfNumbers);
  }

  /// The six equations: the end's origin is at its place, and E = R(q)·R*ᵀ is symmetric.
  NodeId form_all() {
    read_joints();
    PlacementNodes end = a_.at_rest();
    for (std::size_t i = 0; i < kJointsOfArm; ++i)
      end = a_.product(a_.product(end, before_[i]), moved(axis_[i], slides_[i], unknown(i)));
    const VectorNodes gap = a_.difference(end.p, target_.p);
    const MatrixNodes E = a_.product(end.R, a_.transposed(target_.R));
    ClosureLines closure;
    closure.equations = {gap.begin(), gap.end()};
    for (std::size_t i = 0; i < 3; ++i)
      closure.equations.push_back(
          a_.difference(E[(i + 2) % 3][(i + 1) % 3], E[(i + 1) % 3][(i + 2) % 3]));
    for (std::size_t i = 0; i < kJointsOfArm; ++i) {
      closure.names.push_back("joint " + std::to_string(i + 1));
      const auto [middle, radius] = slides_[i] ? range_of_slide(i) : range_of_angle(i);
      closure.middle.push_back(middle);
      closure.radius.push_back(radius);
    }
    q_.closure = std::move(closure);
    return a_.sum(a_.sum(E[0][0], E[1][1]), E[2][2]);
  }

  /// The equations of four angles, in the variables 0 to 3.
  std::vector<NodeId> form_four() {
    find_first();
    close_loop();
    return equations_of(turned_loop());
  }
  /// Returns the joint that is the first of the loop then.
  [[nodiscard]] std::size_t first() const noexcept { return first_; }

 private:
  /// The unknown with a number.
  NodeId unknown(std::size_t number) {
    return q_.graph.add(Op::kVariable, int(q_.variables.size() + number));
  }

  /// The middle and the radius.
  using RangeNodes = std::pair<NodeId, NodeId>;

  RangeNodes range_of_angle(std::size_t joint) {
    return {middle_angle(q_.solutions->solutions, joint, q_.graph), q_.graph.add(Op::kPi)};
  }

  /// The lines are in it. It is no part of the claim: a slide follows from the four angles.
  RangeNodes range_of_slide(std::size_t joint) {
    Interval all = point(0.0);
    for (const SolutionLine& line : q_.solutions->solutions) all = hull(all, line.values[joint]);
    if (!(mag(all) <= kLargest)) throw Rejection("the value of a slide is too large");
    const double radius = std::ldexp(1.0, 2 + std::ilogb(mag(all) + 1.0));
    return {a_.number(0), q_.graph.number(rational_of(radius))};
  }

  // The arm.

  static PlacementNodes frame(const std::array<NodeId, 9>& R, const std::array<NodeId, 3>& p) {
    return {{{{R[0], R[1], R[2]}, {R[3], R[4], R[5]}, {R[6], R[7], R[8]}}}, p};
  }

  /// Shows that the rows of a frame are of length 1 and across each other, and that it is no mirror.
  void require_rotation(const MatrixNodes& R, const std::string& what) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i; j < 3; ++j)
        if (!is_equal(a_.dot(R[i], R[j]), i == j ? 1 : 0))
          throw Unfinished(what + " is not shown to be a rotation");
    const auto volume =
        evaluate(q_.graph, {a_.dot(R[0], a_.cross(R[1], R[2]))}, places_, kBitsOfNumbers);
    if (!volume || arb_is_positive((*volume)[0].get()) == 0)
      throw Unfinished(what + " is not shown not to mirror");
  }

  bool is_equal(NodeId node, long number) {
    return certain_equal(q_.graph, node, a_.number(number), kProductsOfFrame);
  }

  /// Returns the movement of a joint with this value.
  PlacementNodes moved(const VectorNodes& axis, bool slides, NodeId value) {
    if (slides) return {a_.identity(), a_.scaled(value, axis)};
    return {a_.turn(axis, value), zero_};
  }

  /// Joints that keep their values become parts of the links behind them.
  void read_joints() {
    PlacementNodes since = a_.at_rest();
    for (std::size_t i = 0; i < arm_.joints.size(); ++i) {
      const ArmJointLine& joint = arm_.joints[i];
      const PlacementNodes at = frame(joint.rotation, joint.place);
      require_rotation(at.R, "the frame of joint " + std::to_string(i + 1));
      if (!is_equal(a_.dot(joint.axis, joint.axis), 1))
        throw Unfinished("the axis of joint " + std::to_string(i + 1) +
                         " is not shown to be of length 1");
      since = a_.product(since, at);
      if (joint.held != kNoNode) {
        since = a_.product(since, moved(joint.axis, joint.slides, joint.held));
        continue;
      }
      before_.push_back(since);
      axis_.push_back(joint.axis);
      slides_.push_back(joint.slides);
      since = a_.at_rest();
    }
    target_ = arm_.tool.empty() ? placed_by_values(since) : placed_by_tool(since);
  }

  /// The last joint that moves is where it is if the uncertain quantities are in the middles of their ranges. `behind`:
  /// from the last free joint to it.
  PlacementNodes placed_by_values(const PlacementNodes& behind) {
    PlacementNodes end = a_.at_rest();
    for (std::size_t i = 0; i < kJointsOfArm; ++i)
      end = a_.product(a_.product(end, before_[i]), moved(axis_[i], slides_[i], arm_.values[i]));
    if (q_.variables.empty()) return end;
    end = a_.product(end, behind);
    for (VectorNodes& row : end.R) row = in_middle(row);
    end.p = in_middle(end.p);
    return a_.product(end, a_.inverse(behind));
  }

  VectorNodes in_middle(VectorNodes v) {
    std::map<NodeId, NodeId> middles;
    for (std::size_t k = 0; k < q_.variables.size(); ++k)
      middles.emplace(q_.graph.add(Op::kVariable, int(k)),
                      a_.quotient(a_.sum(q_.variables[k].lo, q_.variables[k].hi), a_.number(2)));
    for (NodeId& node : v) node = replaced(q_.graph, node, middles);
    return v;
  }

  /// Returns the frame that the last free joint turns.
  PlacementNodes placed_by_tool(const PlacementNodes& behind) {
    const std::vector<NodeId>& at = arm_.tool;
    const PlacementNodes tool = {a_.turn_of_roll_pitch_yaw({at[3], at[4], at[5]}),
                                 {at[0], at[1], at[2]}};
    std::array<NodeId, 9> R{};
    std::copy_n(arm_.tip.begin(), R.size(), R.begin());
    const PlacementNodes tip = frame(R, {arm_.tip[9], arm_.tip[10], arm_.tip[11]});
    require_rotation(tip.R, "the frame of the tool");
    return a_.product(tool, a_.inverse(a_.product(behind, tip)));
  }

  // The loop.

  /// If a joint slides, it is to be the third.
  void find_first() {
    if (std::ranges::count(slides_, true) > 1) throw Unfinished("more than one joint slides");
    const auto slide = std::ranges::find(slides_, true);
    if (slide == slides_.end()) return;
    const std::size_t before = std::size_t(slide - slides_.begin()) + kJointsOfArm - 2;
    if (before % kPairsOfJoints != first_ % kPairsOfJoints)
      throw Rejection("the line 'opposite' is not about the joint that slides");
    first_ = before % kJointsOfArm;
    has_slide_ = true;
  }

  /// O₁J₁…O₆J₆ = T is J₁O₂J₂…O₆J₆(T⁻¹O₁) = 1.
  void close_loop() {
    for (std::size_t i = 0; i + 1 < kJointsOfArm; ++i) loop_.behind[i] = before_[i + 1];
    loop_.behind[kJointsOfArm - 1] = a_.product(a_.inverse(target_), before_[0]);
    for (std::size_t i = 0; i < kJointsOfArm; ++i) loop_.axis[i] = axis_[i];
    for (std::size_t i = 1; i <= kJointsOfArm; ++i) move_origin(i % kJointsOfArm);
  }

  /// A shift along its axis does not change a joint. It brings the origin near the axis before, where
  /// more coefficients are small.
  void move_origin(std::size_t joint) {
    PlacementNodes& before = loop_.behind[(joint + kJointsOfArm - 1) % kJointsOfArm];
    PlacementNodes& behind = loop_.behind[joint];
    const Three b = approx(loop_.axis[(joint + kJointsOfArm - 1) % kJointsOfArm]),
                a = approx(a_.product(before.R, loop_.axis[joint])), d = approx(before.p);
    const double ab = approx_dot(a, b), across = 1 - ab * ab;
    const double shift = across < kParallel ? -approx_dot(d, a)
                                            : (ab * approx_dot(d, b) - approx_dot(d, a)) / across;
    if (!std::isfinite(shift)) return;
    const NodeId t = q_.graph.number(rational_of(shift));
    const VectorNodes along = a_.scaled(t, loop_.axis[joint]);
    before.p = a_.sum(before.p, a_.product(before.R, along));
    behind.p = a_.difference(behind.p, along);
  }

  Three approx(const VectorNodes& v) {
    const auto values = evaluate(q_.graph, {v[0], v[1], v[2]}, places_, kBitsOfNumbers);
    if (!values) throw Unfinished("a number of the arm has no certain value");
    return {mid((*values)[0].enclosure()), mid((*values)[1].enclosure()),
            mid((*values)[2].enclosure())};
  }

  Loop turned_loop() const {
    Loop result;
    for (std::size_t i = 0; i < kJointsOfArm; ++i) {
      result.axis[i] = loop_.axis[(i + first_) % kJointsOfArm];
      result.behind[i] = loop_.behind[(i + first_) % kJointsOfArm];
    }
    return result;
  }

  // The equations, as PROOF.md derives them.

  /// Returns the sum of a form times 1, cos, sin of one variable and 1, cos, sin of another.
  NodeId expression(const Number& form, std::size_t first, std::size_t second) {
    const auto powers = [this](std::size_t variable) {
      const NodeId x = unknown(variable);
      return VectorNodes{a_.number(1), a_.cosine(x), a_.sine(x)};
    };
    const VectorNodes u = powers(first), v = powers(second);
    return a_.dot(u, {a_.dot(v, form[0]), a_.dot(v, form[1]), a_.dot(v, form[2])});
  }

  using Side = std::array<Number, 5>;

  /// A slide along k changes no product of the point with a vector across k, and none of the direction. `seen`:
  /// the products with a vector.
  template <class Seen>
  Side along_slide(const VectorNodes& k, const Seen& seen) {
    const Three near = approx(k);
    std::size_t least = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (std::fabs(near[i]) < std::fabs(near[least])) least = i;
    VectorNodes unit = zero_;
    unit[least] = a_.number(1);
    const VectorNodes e = a_.cross(k, unit), f = a_.cross(k, e);
    const auto [point_e, direction_e] = seen(e);
    const auto [point_f, direction_f] = seen(f);
    return {point_e, point_f, direction_e, direction_f, seen(k).second};
  }

  /// By the joints 1 and 2: P and L are where axis 6 is, seen from joint 3.
  Side side_of_base(const Loop& loop) {
    const PlacementNodes back = a_.inverse(loop.behind[5]);
    const VectorNodes g = back.p, h = a_.product(back.R, loop.axis[5]), d1 = loop.behind[0].p,
                      d2 = loop.behind[1].p;
    const MatrixNodes R1 = a_.transposed(loop.behind[0].R);
    const VectorNodes k = a_.product(loop.behind[1].R, loop.axis[2]);
    const auto back1 = [&](const VectorNodes& v) {
      return turned(constant(v), Angle::kFirst, loop.axis[0], -1);
    };
    const auto back2 = [&](const Form& form) {
      return turned(times(R1, form), Angle::kSecond, loop.axis[1], -1);
    };
    const Form w = back1(g), H = back1(h), x = back2(minus(w, d1)), M = back2(H),
               N = back2(difference(back1(a_.cross(g, h)), cross(d1, H)));
    if (has_slide_)
      return along_slide(loop.axis[2], [&](const VectorNodes& by) {
        const VectorNodes v = a_.product(loop.behind[1].R, by);
        return std::pair(dot(v, minus(x, d2)), dot(v, M));
      });
    const NodeId squares = a_.sum(a_.sum(a_.dot(g, g), a_.dot(d1, d1)), a_.dot(d2, d2));
    return {dot(k, minus(x, d2)), dot(k, M),
            plus(plus(number(squares), dot(d1, w), -2), dot(d2, x), -2),
            plus(plus(number(a_.dot(g, h)), dot(d1, H), -1), dot(d2, M), -1),
            dot(k, difference(N, cross(d2, M)))};
  }

  /// By the joints 4 and 5.
  Side side_of_end(const Loop& loop) {
    const PlacementNodes &B3 = loop.behind[2], &B4 = loop.behind[3], &B5 = loop.behind[4];
    const VectorNodes &d3 = B3.p, &d4 = B4.p, &d5 = B5.p, l = a_.product(B5.R, loop.axis[5]);
    const MatrixNodes R3 = a_.transposed(B3.R);
    const VectorNodes k = a_.product(R3, loop.axis[2]), d = a_.product(R3, d3),
                      e = a_.product(a_.transposed(B4.R), d4);
    const auto by5 = [&](const VectorNodes& v) {
      return turned(constant(v), Angle::kSecond, loop.axis[4], 1);
    };
    const auto by4 = [&](const Form& form) { return turned(form, Angle::kFirst, loop.axis[3], 1); };
    const Form D = by5(d5), u = by5(l), m = by5(a_.cross(d5, l)), u4 = times(B4.R, u);
    const Form W = by4(plus(times(B4.R, D), d4)), U = by4(u4),
               C = by4(sum(cross(d4, u4), times(B4.R, m)));
    if (has_slide_)
      return along_slide(loop.axis[2], [&](const VectorNodes& by) {
        const VectorNodes v = a_.product(R3, by);
        return std::pair(plus(number(a_.dot(by, d3)), dot(v, W)), dot(v, U));
      });
    const NodeId squares = a_.sum(a_.sum(a_.dot(d3, d3), a_.dot(d4, d4)), a_.dot(d5, d5));
    return {plus(number(a_.dot(loop.axis[2], d3)), dot(k, W)), dot(k, U),
            plus(plus(number(squares), dot(e, D), 2), dot(d, W), 2),
            plus(plus(number(a_.dot(d5, l)), dot(e, u)), dot(d, U)), dot(k, sum(C, cross(d, U)))};
  }

  std::vector<NodeId> equations_of(const Loop& loop) {
    const Side base = side_of_base(loop), end = side_of_end(loop);
    std::vector<NodeId> result;
    for (std::size_t e = 0; e < base.size(); ++e)
      result.push_back(a_.difference(expression(base[e], 0, 1), expression(end[e], 2, 3)));
    return result;
  }

  Question& q_;
  const ArmLines arm_;
  std::size_t first_;
  bool has_slide_ = false;
  std::vector<Ball> places_;  ///< of the uncertain quantities
  std::vector<PlacementNodes> before_;
  std::vector<VectorNodes> axis_;
  std::vector<bool> slides_;
  PlacementNodes target_{};
  Loop loop_{};
};

}  // namespace

PostureSearch form_posture_equations(Question& question, std::size_t pair) {
  ArmEquations equations(question, pair);
  const NodeId trace = equations.form_all();
  std::vector<NodeId> four = equations.form_four();
  PostureSearch search{question};
  const ClosureLines& all = *question.closure;
  ClosureLines closure;
  search.trace = trace;
  search.also = four.back();
  four.pop_back();
  closure.equations = std::move(four);
  for (const std::size_t joint : kSearched) {
    const std::size_t i = (joint + equations.first()) % kJointsOfArm;
    search.searched.push_back(i);
    closure.names.push_back(all.names[i]);
    closure.middle.push_back(all.middle[i]);
    closure.radius.push_back(all.radius[i]);
  }
  search.question.closure = std::move(closure);
  return search;
}

}  // namespace regulus::verifier
