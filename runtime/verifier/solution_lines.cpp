// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/solution_lines.hpp"

#include <algorithm>
#include <array>

#include "runtime/verifier/constant_lines.hpp"
#include "runtime/verifier/moving_arm.hpp"
#include "runtime/verifier/planar_platform.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

constexpr std::size_t kLegsInSpace = 6, kValuesInSpace = 7, kValuesInPlane = 3;
constexpr std::string_view kPlusMinus = " +- ";
/// A line `leg` has so many bars.
constexpr std::ptrdiff_t kBarsInPlane = 4;
struct JointKey {
  const char* word;
  bool slides, is_held, follows;
};
constexpr std::array<JointKey, 6> kJointKeys = {{{"joint", false, false, false},
                                                 {"held-joint", false, true, false},
                                                 {"following-joint", false, false, true},
                                                 {"sliding-joint", true, false, false},
                                                 {"held-sliding-joint", true, true, false},
                                                 {"following-sliding-joint", true, false, true}}};
constexpr std::size_t kMostJoints = 64, kNumbersOfJoint = 15, kNumbersOfFollower = 18,
                      kNumbersOfFrame = 12, kNumbersOfTool = 6;

class SolutionReader {
 public:
  SolutionReader(Lines& lines, Question& q)
      : lines_(lines),
        q_(q),
        reader_(lines, q),
        s_(*q.solutions),
        values_(q.closure ? q.closure->names.size() : kValuesInSpace),
        legs_(q.closure ? 0 : kLegsInSpace) {}

  void read() {
    if (legs_ != 0 && reader_.is("leg") && std::ranges::count(lines_.text(), '|') == kBarsInPlane) {
      axes_ = 2;
      values_ = kValuesInPlane;
      legs_ = kLegsInPlane;
    }
    if (legs_ != 0 && is_joint()) read_arm();
    while (reader_.is("leg")) read_leg();
    if (s_.legs.size() != legs_)
      throw Rejection("expected " + std::to_string(legs_) + " lines 'leg E | … | E'");
    while (reader_.is("solution")) read_solution();
    if (s_.solutions.empty() != (s_.verdict == format::kNone))
      throw Rejection(
          "the verdict " + s_.verdict +
          (s_.solutions.empty() ? " needs a line 'solution'" : " has no line 'solution'"));
  }

 private:
  void read_arm() {
    legs_ = 0;
    ArmLines& arm = s_.arm.emplace();
    while (is_joint()) read_joint(arm);
    if (reader_.is("turning-tool")) read_turning_tool(arm);
    require_leaders(arm);
    values_ = std::size_t(std::ranges::count_if(arm.joints, is_free));
    if (values_ != kJointsOfArm && values_ != kJointsOfLevelArm)
      throw Rejection("expected 6 or 4 lines of joints that are free, found " +
                      std::to_string(values_));
    if (values_ != kJointsOfArm && arm.joints.back().is_of_tool)
      throw Rejection("a tool that may be turned is of an arm of five joints");
    while (reader_.is("joint-range")) read_range(arm);
    if (!reader_.is("tip")) {
      for (std::size_t k = 0; k < values_; ++k, reader_.advance())
        arm.values.push_back(reader_.expression("joint-value", std::to_string(k),
                                                reader_.rest_of("joint-value"), q_.actual));
      return;
    }
    arm.tip = numbers("tip", "tip ", kNumbersOfFrame, kNumbersOfFrame);
    arm.tool = numbers("tool", "tool ", kNumbersOfTool, kNumbersOfTool);
  }

  [[nodiscard]] bool is_joint() const {
    return std::ranges::any_of(kJointKeys,
                               [this](const JointKey& key) { return reader_.is(key.word); });
  }

  static bool follows(const ArmJointLine& joint) { return joint.leader != ArmJointLine::kNone; }
  static bool is_free(const ArmJointLine& joint) {
    return joint.held == kNoNode && !follows(joint);
  }

  /// Behind the other numbers a line of a joint that is held has a value, and one of a joint that follows another the
  /// number of that line, a multiplier and an offset.
  void read_joint(ArmLines& arm) {
    if (arm.joints.size() == kMostJoints) throw Rejection("there are too many joints");
    const JointKey& key = *std::ranges::find_if(
        kJointKeys, [this](const JointKey& each) { return reader_.is(each.word); });
    const std::size_t count = key.follows   ? kNumbersOfFollower
                              : key.is_held ? kNumbersOfJoint + 1
                                            : kNumbersOfJoint;
    const std::vector<NodeId> all =
        numbers(key.word, "joint " + std::to_string(arm.joints.size()) + '_', count,
                key.is_held ? count : kNumbersOfJoint);
    ArmJointLine joint;
    joint.slides = key.slides;
    std::copy_n(all.begin(), 9, joint.rotation.begin());
    std::copy_n(all.begin() + 9, 3, joint.place.begin());
    std::copy_n(all.begin() + 12, 3, joint.axis.begin());
    if (key.is_held) joint.held = all.back();
    if (key.follows) {
      joint.leader = number_of_line(all[kNumbersOfJoint]);
      joint.multiplier = all[kNumbersOfJoint + 1];
      joint.offset = all[kNumbersOfJoint + 2];
    }
    arm.joints.push_back(joint);
  }

  /// Reads the frame of the tool. Its turn about the z axis is a free joint.
  void read_turning_tool(ArmLines& arm) {
    const std::vector<NodeId> all =
        numbers("turning-tool", "joint " + std::to_string(arm.joints.size()) + '_', kNumbersOfFrame,
                kNumbersOfFrame);
    const NodeId none = q_.graph.number(Rational(0L));
    ArmJointLine& turn = arm.joints.emplace_back();
    turn.is_of_tool = true;
    std::copy_n(all.begin(), 9, turn.rotation.begin());
    std::copy_n(all.begin() + 9, 3, turn.place.begin());
    turn.axis = {none, none, q_.graph.number(Rational(1L))};
  }

  /// Returns a number that is stated from 1, counted from 0.
  std::size_t number_of_line(NodeId stated) const {
    const Node& node = q_.graph.nodes()[std::size_t(stated)];
    for (std::size_t k = 0; node.op == Op::kConstant && k < kMostJoints; ++k)
      if (q_.graph.rational(node.a) == Rational(long(k) + 1)) return k;
    throw Rejection("a joint that follows another names no line of a joint");
  }

  static void require_leaders(const ArmLines& arm) {
    for (const ArmJointLine& joint : arm.joints)
      if (follows(joint) &&
          (joint.leader >= arm.joints.size() || follows(arm.joints[joint.leader]) ||
           arm.joints[joint.leader].is_of_tool))
        throw Rejection("a joint follows line " + std::to_string(joint.leader + 1) +
                        " of joints, which is none of a joint that follows no other");
  }

  /// Reads `joint-range N in E : E`, with N rising.
  void read_range(ArmLines& arm) {
    const auto [joint, range] = reader_.two_parts("joint-range", " in ");
    const std::size_t number = read_count(joint, values_), mark = range.find(" : ");
    if (number == 0 || (!arm.ranges.empty() && number <= arm.ranges.back().joint + 1))
      throw Rejection("the joints of ranges are counted from 1, and rise");
    if (mark == std::string_view::npos) throw Rejection("expected 'joint-range N in E : E'");
    const std::string name = std::to_string(number - 1);
    const NodeId lower = reader_.constant("joint-range", name, range.substr(0, mark)),
                 upper = reader_.constant("joint-range-end", name, range.substr(mark + 3));
    arm.ranges.push_back({number - 1, lower, upper});
    reader_.advance();
  }

  /// Reads a line `KEY E | E | …`. The stated values are KIND and the number of each. The first `uncertain` ones may
  /// depend on the constants of the robot.
  std::vector<NodeId> numbers(const char* key, const std::string& kind, std::size_t count,
                              std::size_t uncertain) {
    const Scope none;
    std::string_view rest = reader_.rest_of(key);
    std::vector<NodeId> result;
    const std::size_t space = kind.find(' ');
    for (std::size_t i = 0; i < count && !rest.empty(); ++i)
      result.push_back(reader_.expression(kind.substr(0, space).c_str(),
                                          kind.substr(space + 1) + std::to_string(i), part(rest),
                                          i < uncertain ? q_.actual : none));
    if (!rest.empty() || result.size() != count)
      throw Rejection("expected " + std::to_string(count) + " expressions after '" + key + "'");
    reader_.advance();
    return result;
  }

  /// Reads `leg`, the anchor at the base, that at the platform, and the squared length, which may be
  /// within a distance of its value.
  void read_leg() {
    if (s_.legs.size() == legs_)
      throw Rejection("there are more than " + std::to_string(legs_) + " legs");
    std::string_view rest = reader_.rest_of("leg");
    const std::string number = std::to_string(s_.legs.size());
    LegLine leg;
    for (std::size_t axis = 0; axis < axes_; ++axis)
      leg.base[axis] = anchor("base", number + '_' + "xyz"[axis], rest);
    for (std::size_t axis = 0; axis < axes_; ++axis)
      leg.platform[axis] = anchor("platform", number + '_' + "xyz"[axis], rest);
    leg.square = square(number, rest);
    s_.legs.push_back(leg);
    reader_.advance();
  }

  /// Takes the text up to the next bar.
  static std::string_view part(std::string_view& rest) {
    const std::size_t bar = rest.find(" | ");
    const std::string_view text = rest.substr(0, bar);
    rest = bar == std::string_view::npos ? std::string_view() : rest.substr(bar + 3);
    return text;
  }
  NodeId constant(const char* kind, const std::string& name, std::string_view& rest) {
    return reader_.constant(kind, name, part(rest));
  }
  NodeId anchor(const char* kind, const std::string& name, std::string_view& rest) {
    return reader_.expression(kind, name, part(rest), q_.actual);
  }

  NodeId square(const std::string& number, std::string_view rest) {
    if (rest.empty() || rest.find(" | ") != std::string_view::npos)
      throw Rejection("expected " + std::to_string(2 * axes_ + 1) + " expressions after 'leg'");
    const std::size_t mark = rest.find(kPlusMinus);
    const NodeId middle = reader_.constant("square", number, rest.substr(0, mark));
    if (mark == std::string_view::npos) return middle;
    const NodeId spread =
        reader_.constant("square-spread", number, rest.substr(mark + kPlusMinus.size()));
    if (q_.variables.size() == format::kMostVariables) throw Rejection("too many variables");
    const NodeId node = q_.graph.add(Op::kVariable, int(q_.variables.size()));
    q_.variables.push_back({"square " + number, VariableKind::kError,
                            q_.graph.add(Op::kSubtract, middle, spread),
                            q_.graph.add(Op::kAdd, middle, spread)});
    return node;
  }

  void read_solution() {
    if (s_.solutions.size() == format::kMostSolutions)
      throw Rejection("there are too many solutions");
    const auto words = words_of(lines_.text());
    if (words.size() != 1 + values_)
      throw Rejection("expected " + std::to_string(values_) + " intervals after 'solution'");
    SolutionLine solution{lines_.number(), {}};
    for (std::size_t i = 1; i < words.size(); ++i) solution.values.push_back(interval(words[i]));
    s_.solutions.push_back(std::move(solution));
    reader_.advance();
  }

  static Interval interval(std::string_view word) {
    const std::size_t colon = word.find(':');
    if (colon == std::string_view::npos) throw Rejection("expected intervals LO:HI");
    const Interval x{read_double(word.substr(0, colon)), read_double(word.substr(colon + 1))};
    if (!(x.lo <= x.hi)) throw Rejection("the interval " + std::string(word) + " is empty");
    return x;
  }

  Lines& lines_;
  Question& q_;
  ConstantLines reader_;
  SolutionLines& s_;
  std::size_t values_, legs_, axes_ = 3;
};

}  // namespace

std::string ArmLines::description() const {
  const auto is_following = [](const ArmJointLine& joint) {
    return joint.leader != ArmJointLine::kNone;
  };
  const auto is_free = [&](const ArmJointLine& joint) {
    return joint.held == kNoNode && !is_following(joint);
  };
  return format::describe_arm(std::size_t(std::ranges::count_if(joints, is_free)),
                              joints.back().is_of_tool, std::ranges::any_of(joints, is_following),
                              !ranges.empty());
}

void read_solution_lines(Lines& lines, Question& question) {
  SolutionReader(lines, question).read();
}

void read_from_lines(Lines& lines, SolutionLines& claim, std::size_t numbers) {
  while (lines.text().starts_with(kFromLine)) {
    const auto words = words_of(lines.text());
    if (words.size() != 1 + numbers)
      throw Rejection("expected " + std::to_string(numbers) + " numbers after 'from'");
    if (claim.from.size() == claim.solutions.size())
      throw Rejection("a line 'from' is of a line 'solution'");
    std::vector<double>& at = claim.from.emplace_back();
    for (std::size_t i = 1; i < words.size(); ++i) at.push_back(read_double(words[i]));
    if (!lines.next()) throw Rejection("the file ends before the line 'end'");
  }
  if (!claim.from.empty() && claim.from.size() != claim.solutions.size())
    throw Rejection("expected a line 'from' for each line 'solution'");
}

}  // namespace regulus::verifier
