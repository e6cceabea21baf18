// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/moving_arm.hpp"

#include <algorithm>
#include <numeric>

#include "runtime/verifier/algebra.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/trig_sums.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfFrame = 128;
constexpr std::uint64_t kProductsOfFrame = 1 << 16;

class ArmReader {
 public:
  ArmReader(Question& q, const std::vector<Ball>& places)
      : q_(q), arm_(*q.solutions->arm), a_(q.graph), places_(places) {}

  MovingArm read() {
    find_free_joints();
    for (std::size_t i = 0; i < arm_.joints.size(); ++i) read(arm_.joints[i], i);
    find_turns();
    result_.target = arm_.tool.empty() ? placed_by_values() : placed_by_tool();
    if (result_.free.size() == kJointsOfLevelArm) find_direction();
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool is_free(const ArmJointLine& joint) const {
    return joint.held == kNoNode && joint.leader == ArmJointLine::kNone;
  }

  void find_free_joints() {
    for (const ArmJointLine& joint : arm_.joints) {
      number_.push_back(result_.free.size());
      if (is_free(joint)) result_.free.push_back({joint.slides});
    }
    for (const JointRange& range : arm_.ranges) {
      result_.free[range.joint].lower = range.lower;
      result_.free[range.joint].upper = range.upper;
    }
  }

  void read(const ArmJointLine& joint, std::size_t number) {
    const std::string name = "joint " + std::to_string(number + 1);
    require_values({joint.rotation.begin(), joint.rotation.end()}, name);
    require_values({joint.place.begin(), joint.place.end()}, name);
    require_values({joint.axis.begin(), joint.axis.end()}, name);
    const PlacementNodes at = frame(joint.rotation, joint.place);
    require_rotation(at.R, "the frame of " + name);
    if (!is_equal(a_.dot(joint.axis, joint.axis), a_.number(1)))
      throw Unfinished("the axis of " + name + " is not shown to be of length 1");
    MovingJoint moving{a_.product(since_, at), joint.axis, joint.slides, number_[number],
                       a_.number(1)};
    since_ = moving.before;
    NodeId kept = joint.held;
    if (joint.leader != ArmJointLine::kNone) {
      const ArmJointLine& leader = arm_.joints[joint.leader];
      moving.leader = number_[joint.leader];
      moving.factor = factor_of(joint, name);
      kept = joint.offset;
      if (leader.held != kNoNode)
        kept = a_.sum(a_.product(moving.factor, leader.held), kept);
      else if (!a_.is_number(moving.factor, 0))
        return add(std::move(moving), kept);
    } else if (kept == kNoNode) {
      return add(std::move(moving), a_.number(0));
    }
    since_ = a_.product(since_, result_.moved(a_, moving, kept));
  }

  /// The movement by an offset is before the other one, and about or along the same axis.
  void add(MovingJoint joint, NodeId offset) {
    if (!a_.is_number(offset, 0))
      joint.before = a_.product(joint.before, result_.moved(a_, joint, offset));
    since_ = a_.at_rest();
    result_.joints.push_back(std::move(joint));
  }

  NodeId factor_of(const ArmJointLine& joint, const std::string& name) {
    require_values({joint.multiplier, joint.offset}, name);
    const auto value = exact_value(q_.graph, joint.multiplier);
    return value ? q_.graph.number(*value) : joint.multiplier;
  }

  void require_values(const std::vector<NodeId>& numbers, const std::string& what) {
    if (!evaluate(q_.graph, numbers, places_, kBitsOfFrame))
      throw Unfinished("a number of " + what + " has no certain value");
  }

  static PlacementNodes frame(const std::array<NodeId, 9>& R, const std::array<NodeId, 3>& p) {
    return {{{{R[0], R[1], R[2]}, {R[3], R[4], R[5]}, {R[6], R[7], R[8]}}}, p};
  }

  /// Shows that the rows of a frame are of length 1 and across each other, and that it is no mirror.
  void require_rotation(const MatrixNodes& R, const std::string& what) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i; j < 3; ++j)
        if (!is_equal(a_.dot(R[i], R[j]), a_.number(i == j ? 1 : 0)))
          throw Unfinished(what + " is not shown to be a rotation");
    const auto volume =
        evaluate(q_.graph, {a_.dot(R[0], a_.cross(R[1], R[2]))}, places_, kBitsOfFrame);
    if (!volume || arb_is_positive((*volume)[0].get()) == 0)
      throw Unfinished(what + " is not shown not to mirror");
  }

  bool is_equal(NodeId node, NodeId other) {
    return certain_equal(q_.graph, node, other, kProductsOfFrame);
  }

  // Which turns bring all back.

  void find_turns() {
    for (std::size_t k = 0; k < result_.free.size(); ++k) {
      FreeJoint& free = result_.free[k];
      free.turns = free.slides ? 0 : 1;
      std::size_t moved = 0;
      for (const MovingJoint& joint : result_.joints) {
        if (joint.leader != k) continue;
        free.is_alone = ++moved == 1;
        free.turns = joint.slides ? 0 : common_turns(free.turns, joint.factor);
      }
    }
  }

  long common_turns(long turns, NodeId factor) {
    const auto value = exact_value(q_.graph, factor);
    if (!value || turns == 0) return 0;
    const fmpz* denominator = fmpq_denref(value->get());
    if (fmpz_cmp_si(denominator, kMostTurns) > 0) return 0;
    const long both = std::lcm(turns, long(fmpz_get_si(denominator)));
    return both > kMostTurns ? 0 : both;
  }

  // The place.

  /// The last joint of all is where it is if the uncertain quantities that no value of a joint names are in the middles
  /// of their ranges.
  PlacementNodes placed_by_values() {
    PlacementNodes end = result_.end(a_, arm_.values);
    if (q_.variables.empty()) return end;
    end = a_.product(end, since_);
    for (VectorNodes& row : end.R) row = in_middle(row);
    end.p = in_middle(end.p);
    return a_.product(end, a_.inverse(since_));
  }

  VectorNodes in_middle(VectorNodes v) {
    std::vector<NodeId> values = arm_.values;
    for (const ArmJointLine& joint : arm_.joints)
      if (joint.held != kNoNode) values.push_back(joint.held);
    const std::vector<NodeId> named = ingredients(q_.graph, values);
    std::map<NodeId, NodeId> middles;
    for (std::size_t k = 0; k < q_.variables.size(); ++k) {
      const NodeId variable = q_.graph.add(Op::kVariable, int(k));
      if (std::ranges::find(named, variable) == named.end())
        middles.emplace(variable,
                        a_.quotient(a_.sum(q_.variables[k].lo, q_.variables[k].hi), a_.number(2)));
    }
    for (NodeId& node : v) node = replaced(q_.graph, node, middles);
    return v;
  }

  PlacementNodes placed_by_tool() {
    const std::vector<NodeId>& at = arm_.tool;
    require_values(at, "the tool");
    require_values(arm_.tip, "the tool");
    const PlacementNodes tool = {a_.turn_of_roll_pitch_yaw({at[3], at[4], at[5]}),
                                 {at[0], at[1], at[2]}};
    std::array<NodeId, 9> R{};
    std::copy_n(arm_.tip.begin(), R.size(), R.begin());
    const PlacementNodes tip = frame(R, {arm_.tip[9], arm_.tip[10], arm_.tip[11]});
    require_rotation(tip.R, "the frame of the tool");
    return a_.product(tool, a_.inverse(a_.product(since_, tip)));
  }

  // Arms that turn about one direction. PROOF.md, "All postures".

  void find_direction() {
    require_certain_rotations();
    MatrixNodes R = a_.identity();
    std::vector<VectorNodes> turns(result_.free.size(), a_.zero());
    for (const MovingJoint& joint : result_.joints) {
      R = a_.product(R, joint.before.R);
      if (joint.slides) continue;
      VectorNodes& sum = turns[joint.leader];
      sum = a_.sum(sum, a_.scaled(joint.factor, a_.product(R, joint.axis)));
    }
    const auto is_direction = [this](const VectorNodes& v) {
      return is_certainly_not(v, a_.zero());
    };
    const auto found = std::ranges::find_if(turns, is_direction);
    if (found == turns.end()) throw Unfinished("no joint of the arm is shown to turn its end");
    const VectorNodes &of_base = *found, of_end = a_.product(a_.transposed(R), of_base);
    if (!is_carried_to(of_end, of_base))
      throw Unfinished("the arm is not shown to turn about one direction alone");
    result_.direction = of_base;
    // By values of the joints the place has an orientation of the arm.
    if (arm_.tool.empty()) return;
    const VectorNodes at_target = a_.product(result_.target.R, of_end);
    result_.is_turned_away = is_certainly_not(at_target, of_base);
    if (!result_.is_turned_away && !are_equal(at_target, of_base))
      throw Unfinished("the place is not shown to have an orientation of the arm");
  }

  void require_certain_rotations() {
    std::vector<NodeId> numbers;
    const auto take = [&](const MatrixNodes& R) {
      for (const VectorNodes& row : R) numbers.insert(numbers.end(), row.begin(), row.end());
    };
    for (const MovingJoint& joint : result_.joints) {
      take(joint.before.R);
      numbers.insert(numbers.end(), joint.axis.begin(), joint.axis.end());
      numbers.push_back(joint.factor);
    }
    take(since_.R);
    for (const NodeId part : ingredients(q_.graph, numbers))
      if (q_.graph.nodes()[std::size_t(part)].op == Op::kVariable)
        throw Unfinished("an angle of an arm of four joints has a tolerance");
  }

  bool is_certainly_not(const VectorNodes& v, const VectorNodes& other) {
    const VectorNodes gap = a_.difference(v, other);
    const auto values = evaluate(q_.graph, {gap[0], gap[1], gap[2]}, places_, kBitsOfFrame);
    return values && std::ranges::any_of(
                         *values, [](const Ball& x) { return arb_contains_zero(x.get()) == 0; });
  }

  bool are_equal(const VectorNodes& v, const VectorNodes& other) {
    return is_equal(v[0], other[0]) && is_equal(v[1], other[1]) && is_equal(v[2], other[2]);
  }

  /// True if the joints turn a direction of the end to one of the base, whatever their values are.
  bool is_carried_to(const VectorNodes& of_end, const VectorNodes& of_base) {
    TrigSums sums(q_.graph, result_.free.size());
    TrigVector v = sums.constant(of_end);
    for (std::size_t i = result_.joints.size(); i-- > 0;) {
      const MovingJoint& joint = result_.joints[i];
      if (!joint.slides) v = sums.turned(v, joint.axis, joint.leader, joint.factor, 1);
      v = sums.product(joint.before.R, v);
    }
    const TrigVector gap = sums.sum(v, sums.constant(of_base), -1);
    for (const TrigSum& part : gap)
      for (const auto& [functions, coefficient] : part)
        if (!is_equal(coefficient, a_.number(0))) return false;
    return true;
  }

  Question& q_;
  const ArmLines& arm_;
  GraphAlgebra a_;
  const std::vector<Ball>& places_;
  std::vector<std::size_t> number_;      ///< by line: how many free joints come before it
  PlacementNodes since_ = a_.at_rest();  ///< from the last joint that moves
  MovingArm result_;
};

}  // namespace

PlacementNodes MovingArm::moved(GraphAlgebra& algebra, const MovingJoint& joint,
                                NodeId value) const {
  if (joint.slides) return {algebra.identity(), algebra.scaled(value, joint.axis)};
  return {algebra.turn(joint.axis, value), algebra.zero()};
}

PlacementNodes MovingArm::end(GraphAlgebra& algebra, const std::vector<NodeId>& values) const {
  PlacementNodes end = algebra.at_rest();
  for (const MovingJoint& joint : joints)
    end =
        algebra.product(algebra.product(end, joint.before),
                        moved(algebra, joint, algebra.product(joint.factor, values[joint.leader])));
  return end;
}

MovingArm read_moving_arm(Question& question, const std::vector<Ball>& places) {
  return ArmReader(question, places).read();
}

}  // namespace regulus::verifier
