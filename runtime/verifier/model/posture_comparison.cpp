// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/posture_comparison.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/model/joint_chain.hpp"
#include "runtime/verifier/model/place_comparison.hpp"
#include "runtime/verifier/model/place_reading.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfRange = 1024;

class PostureComparison : private PlaceReading {
 public:
  PostureComparison(QuestionComparer& comparer, SectionReading* section)
      : PlaceReading(comparer, section) {}

  void run() {
    const Scope scope = std::exchange(q_.actual, {});
    name_constants();
    require_known_keys();
    if (q_.variables.empty()) require_no_tolerances();
    const bool is_by_tool = has(motion_ + "tool[0]");
    name_errors(scope);
    const bool has_values = name_joints(is_by_tool);
    SectionArm arm = read_arm(scope);
    const ArmLines& stated = *q_.solutions->arm;
    if (stated.joints.back().is_of_tool) add_turn_of_tool(arm);
    if (arm.joints.size() != stated.joints.size())
      comparer_.refuse_model("its arm has " + std::to_string(arm.joints.size()) +
                             " joints, and not " + std::to_string(stated.joints.size()));
    for (std::size_t k = 0; k < arm.joints.size(); ++k) compare_joint(arm.joints[k], k);
    compare_ranges(arm);
    if (is_by_tool ? stated.tool.empty() : has_values && !stated.tool.empty())
      require_place_option(is_by_tool ? "the motion gives the place of the tool"
                                      : "the motion gives values of the joints");
    if (!stated.tool.empty()) {
      for (std::size_t k = 0; k < stated.joints.size(); ++k)
        if (!arm.joints[k].leader && !arm.joints[k].is_of_tool)
          compare_kept(arm.joints[k], stated.joints[k], "joint " + std::to_string(k) + "_15",
                       is_by_tool);
      return compare_tool(arm.tool, is_by_tool);
    }
    std::size_t free = 0;
    for (std::size_t k = 0; k < arm.joints.size(); ++k)
      if (arm.joints[k].leader)
        continue;
      else if (stated.joints[k].held != kNoNode)
        compare_value(arm.joints[k], "joint " + std::to_string(k) + "_15", has_values);
      else
        compare_value(arm.joints[k], "joint-value " + std::to_string(free++), has_values);
  }

 private:
  /// The value that a joint keeps beside the tool may be an option, as that it keeps one.
  void compare_kept(const SectionJoint& joint, const ArmJointLine& stated, const std::string& key,
                    bool is_by_tool) {
    const bool has_value = value_of(joint.name) != kNoNode;
    if (stated.held != kNoNode)
      compare_value(joint, key, has_value);
    else if (has_value && is_by_tool)
      comparer_.leave_out(comparer_.place_of(motion_ + joint.name),
                          "the certificate has a joint that keeps no value");
  }

  /// Gives each joint its value of the motion, or any. Returns false if the file has no such motion.
  bool name_joints(bool is_by_tool) {
    bool has_all = !is_by_tool;
    Scope values;
    for (const SectionPose& pose : section_->pose()) {
      values[pose.name] = value_of(pose.name);
      has_all = has_all && values[pose.name] != kNoNode;
    }
    if (!has_all && !is_by_tool)
      require_place_option("the motion '" + q_.motion + "' gives no value of each joint");
    for (const auto& [name, value] : values)
      q_.actual.insert_or_assign(name, has_all || (is_by_tool && value != kNoNode)
                                           ? value
                                           : q_.graph.number(Rational(0L)));
    return has_all;
  }

  // Control errors of the place. The certificate has them as uncertain quantities NAME_error, 0 ± the error, which its
  // numbers add to those of the file.

  void name_errors(const Scope& stated) {
    std::set<std::string> left;
    for (const auto& [place, value] : values_)
      if (place.starts_with(motion_ + "error")) left.insert(place);
    if (!q_.solutions->arm->tool.empty()) {
      const std::array<std::string, 6> names = names_of_tool();
      for (std::size_t i = 0; i < names.size(); ++i)
        left.erase(name_error(names[i], i >= 3 && is_arm_in_degrees(values_), stated));
    } else {
      for (const SectionPose& pose : section_->pose())
        left.erase(name_error(pose.name, pose.unit == "deg" || pose.unit == "°", stated));
    }
    for (const std::string& place : left)
      comparer_.leave_out(comparer_.place_of(place), "the claim is without this error");
  }

  /// Returns the place of the error in the file.
  std::string name_error(const std::string& name, bool in_degrees, const Scope& stated) {
    std::string place = motion_ + "error." + name;
    const std::string own = name + "_error";
    const auto variable = stated.find(own);
    const bool is_stated = q_.stated.contains("spread " + own) && variable != stated.end();
    if (!is_stated) return is_zero_error(place) ? place : "";
    if (q_.actual.contains(own))
      comparer_.refuse_model("its constant " + own + " has the name of an error of the place");
    GraphAlgebra algebra(q_.graph);
    comparer_.compare({name, 0, "no error"}, algebra.number(0), "value " + own, "");
    const NodeId number = has(place) ? comparer_.constant_at(place, in_degrees) : algebra.number(0);
    comparer_.compare(comparer_.place_of(place), in_degrees ? algebra.degrees(number) : number,
                      "spread " + own, "tube " + name);
    errors_.emplace(name, variable->second);
    return place;
  }

  [[nodiscard]] bool is_zero_error(const std::string& place) {
    return !has(place) || is_zero_number(q_.graph, comparer_.constant_at(place, false));
  }

  /// With a prefix if a joint has one of the names.
  [[nodiscard]] std::array<std::string, 6> names_of_tool() const {
    std::array<std::string, 6> names = {"x", "y", "z", "roll", "pitch", "yaw"};
    const bool is_taken = std::ranges::any_of(section_->pose(), [&](const SectionPose& pose) {
      return std::ranges::find(names, pose.name) != names.end();
    });
    for (std::string& name : names)
      if (is_taken) name.insert(0, "tool_");
    return names;
  }

  /// `place`: of the number in the file; the certificate has the sum with its error. Without one, an option has given
  /// the number.
  void compare_number(const std::string& name, const std::optional<FilePlace>& place, NodeId number,
                      const std::string& key) {
    GraphAlgebra algebra(q_.graph);
    const auto error = errors_.find(name);
    const auto sum = [&](NodeId x) {
      return error == errors_.end() ? x : algebra.sum(x, error->second);
    };
    if (place) return comparer_.compare(*place, sum(number), key, kPlaceOption);
    std::map<NodeId, NodeId> without;
    for (const auto& [own, variable] : errors_) without.emplace(variable, algebra.number(0));
    const NodeId given = replaced(q_.graph, q_.stated.at(key).node, without);
    for (const NodeId part : ingredients(q_.graph, {given}))
      if (q_.graph.nodes()[std::size_t(part)].op == Op::kVariable)
        comparer_.refuse({name, 0, "a number"}, "an uncertain quantity in it");
    comparer_.compare({name, 0, "a number and its error"}, sum(given), key, "");
  }

  /// A free joint behind all others, about the z axis of the tool.
  void add_turn_of_tool(SectionArm& arm) {
    GraphAlgebra algebra(q_.graph);
    SectionJoint turn{"the tool", false, arm.tool};
    turn.axis = {algebra.number(0), algebra.number(0), algebra.number(1)};
    turn.value = algebra.number(0);
    turn.is_of_tool = true;
    arm.joints.push_back(std::move(turn));
    arm.tool = algebra.at_rest();
  }

  /// By the constants of the certificate if these have tolerances.
  SectionArm read_arm(const Scope& stated) {
    if (q_.variables.empty()) return section_->arm(comparer_);
    const Scope nominal = q_.actual;
    const auto poses = section_->pose();
    for (const auto& [name, node] : stated)
      if (std::ranges::find(poses, name, &SectionPose::name) == poses.end())
        q_.actual.insert_or_assign(name, node);
    SectionArm arm = section_->arm(comparer_);
    q_.actual = nominal;
    return arm;
  }

  void compare_joint(const SectionJoint& joint, std::size_t number) {
    FilePlace from = place_of_joint(values_, joint.name);
    if (joint.leader) from.place = "a joint that follows " + joint.name;
    const ArmJointLine& stated = q_.solutions->arm->joints[number];
    const bool follows = stated.leader != ArmJointLine::kNone;
    if (joint.is_of_tool != stated.is_of_tool)
      comparer_.refuse(from, "a tool that may be turned about its z axis");
    if (joint.leader.has_value() != follows)
      comparer_.refuse(from,
                       follows ? "a joint that follows another" : "a joint that follows none");
    if (follows) compare_following(joint, from, "joint " + std::to_string(number) + '_');
    if (joint.slides != stated.slides)
      comparer_.refuse(from, stated.slides ? "a joint that slides" : "a joint that turns");
    if (stated.held != kNoNode) {
      if (!comparer_.may_differ(kHoldOption)) comparer_.refuse(from, "a joint that is held");
      comparer_.note_difference(joint.name + " keeps its value");
    }
    compare_frame(joint.origin, from, "joint " + std::to_string(number) + '_');
    if (joint.is_of_tool) return;  // the axis is not stated
    for (std::size_t i = 0; i < 3; ++i)
      comparer_.compare(from, joint.axis[i],
                        "joint " + std::to_string(number) + '_' + std::to_string(12 + i));
  }

  void compare_following(const SectionJoint& joint, const FilePlace& from, const std::string& key) {
    const auto of = [&from](const char* what) {
      return FilePlace{std::string(what) + from.place, from.line, from.text};
    };
    const NodeId line = q_.graph.number(Rational(long(*joint.leader) + 1));
    comparer_.compare(of("the line of the leader of "), line, key + "15");
    comparer_.compare(of("the multiplier of "), joint.multiplier, key + "16");
    comparer_.compare(of("the offset of "), joint.offset, key + "17");
  }

  /// The certificate may state larger ranges than the file.
  void compare_ranges(const SectionArm& arm) {
    const ArmLines& stated = *q_.solutions->arm;
    std::vector<std::size_t> free;
    for (std::size_t k = 0; k < stated.joints.size(); ++k)
      if (!arm.joints[k].leader && stated.joints[k].held == kNoNode) free.push_back(k);
    for (const JointRange& range : stated.ranges) {
      const SectionJoint& joint = arm.joints[free[range.joint]];
      const std::string number = std::to_string(range.joint);
      comparer_.note_compared("joint-range " + number);
      comparer_.note_compared("joint-range-end " + number);
      if (joint.range.empty())
        comparer_.leave_out(place_of_joint(values_, joint.name), "it has no range");
      else
        compare_range(joint, range);
    }
  }

  void compare_range(const SectionJoint& joint, const JointRange& stated) {
    const bool in_degrees = !joint.slides && is_arm_in_degrees(values_);
    GraphAlgebra algebra(q_.graph);
    const auto end = [&](const char* which) {
      const NodeId number = comparer_.constant_at(joint.range + which, in_degrees);
      return in_degrees ? algebra.degrees(number) : number;
    };
    const FilePlace from = comparer_.place_of(joint.range + "[0]");
    const auto room = evaluate(q_.graph,
                               {algebra.difference(end("[0]"), stated.lower),
                                algebra.difference(stated.upper, end("[1]"))},
                               {}, kBitsOfRange);
    if (!room) throw Unfinished("the range of " + joint.name + " has no certain value");
    for (const Ball& x : *room) {
      if (arb_is_negative(x.get()) != 0) comparer_.refuse(from, "a smaller range");
      if (arb_is_nonnegative(x.get()) == 0)
        comparer_.leave_out(from, "the range of the certificate is not shown to have all of it");
    }
  }

  void compare_frame(const PlacementNodes& frame, const FilePlace& from, const std::string& key) {
    for (std::size_t i = 0; i < 9; ++i)
      comparer_.compare(from, frame.R[i / 3][i % 3], key + std::to_string(i));
    for (std::size_t i = 0; i < 3; ++i)
      comparer_.compare(from, frame.p[i], key + std::to_string(9 + i));
  }

  void compare_value(const SectionJoint& joint, const std::string& key, bool has_values) {
    if (!has_values) return compare_number(joint.name, {}, kNoNode, key);
    const std::string place = motion_ + joint.name;
    compare_number(joint.name, comparer_.place_of(has(place) ? place : place + "[0]"), joint.value,
                   key);
  }

  void compare_tool(const PlacementNodes& tip, bool is_in_file) {
    if (has(motion_ + "tool[6]"))
      comparer_.refuse_model("the motion's tool has more than six numbers");
    compare_frame(tip, {"the frame of the tool", 0, "another"}, "tip ");
    const bool in_degrees = is_arm_in_degrees(values_);
    GraphAlgebra algebra(q_.graph);
    const std::array<std::string, 6> names = names_of_tool();
    for (std::size_t i = 0; i < 6; ++i) {
      const std::string key = "tool " + std::to_string(i),
                        place = motion_ + "tool[" + std::to_string(i) + ']';
      if (!is_in_file) {
        compare_number(names[i], {}, kNoNode, key);
        continue;
      }
      if (!has(place)) comparer_.refuse_model("the motion's tool has fewer than six numbers");
      const bool is_in_degrees = i >= 3 && in_degrees;
      const NodeId number = comparer_.constant_at(place, is_in_degrees);
      compare_number(names[i], comparer_.place_of(place),
                     is_in_degrees ? algebra.degrees(number) : number, key);
    }
  }

  Scope errors_;  ///< by the names of the place
};

}  // namespace

void compare_postures(QuestionComparer& comparer, SectionReading* section) {
  PostureComparison(comparer, section).run();
}

}  // namespace regulus::verifier
