// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/place_comparison.hpp"

#include <algorithm>
#include <utility>

#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/model/equality.hpp"
#include "runtime/verifier/model/joint_chain.hpp"
#include "runtime/verifier/planar_platform.hpp"
#include "runtime/verifier/quantity_lines.hpp"

namespace regulus::verifier {
namespace {

constexpr std::string_view kGeometry = "geometry.";
constexpr long kBits = 1024;

class PlaceComparison {
 public:
  PlaceComparison(QuestionComparer& comparer, SectionReading* section)
      : comparer_(comparer),
        q_(comparer.question()),
        values_(comparer.values()),
        section_(section),
        motion_("motion." + q_.motion + '.') {}

  void run() {
    if (section_ == nullptr) comparer_.refuse_model("it has none of [gough], [legs] and [serial]");
    const Scope stated = std::exchange(q_.actual, {});
    name_constants();
    if (q_.solutions->arm) return compare_arm(stated);
    const std::vector<SectionLeg> legs = section_->telescopic_legs(comparer_);
    if (legs.size() != q_.solutions->legs.size())
      comparer_.refuse_model("it has " + std::to_string(legs.size()) + " legs, and not " +
                             std::to_string(q_.solutions->legs.size()));
    q_.variables.empty() ? compare_anchors(legs) : compare_uncertain_anchors(stated);
    compare_lengths(legs);
  }

 private:
  [[nodiscard]] bool has(const std::string& place) const { return values_.contains(place); }
  [[nodiscard]] bool starts(WrittenValues::const_iterator at, std::string_view with) const {
    return at != values_.end() && at->first.starts_with(with);
  }

  /// The constants of [geometry] have their values, whatever their tolerances are.
  void name_constants() {
    const Scope none;
    for (auto at = values_.lower_bound(kGeometry); starts(at, kGeometry); ++at) {
      const std::string rest = at->first.substr(kGeometry.size());
      std::string name = rest.substr(0, rest.find_first_of(".["));
      std::string key = rest.substr(name.size());
      if (key.starts_with(".value")) key = key.substr(6);
      if (key.starts_with("["))
        name += '_' + std::to_string(std::stoul(key.substr(1)) + 1);
      else if (!key.empty())
        continue;  // a tolerance, a radius or a group
      const NodeId value = comparer_.expression_at(at->first, none);
      comparer_.expect_defined(comparer_.place_of(at->first), value);
      q_.actual.emplace(name, value);
    }
  }

  /// Returns the value of a pose parameter in the motion, which may be a range from a number to the same;
  /// kNoNode: it has none.
  NodeId value_of(const std::string& pose) {
    const std::string place = motion_ + pose;
    if (has(place)) return comparer_.pose_at(place, pose);
    if (!has(place + "[0]") || !has(place + "[1]") || has(place + "[2]")) return kNoNode;
    const NodeId lo = comparer_.pose_at(place + "[0]", pose),
                 hi = comparer_.pose_at(place + "[1]", pose);
    return equality(q_, lo, hi) == Equality::kEqual ? lo : kNoNode;
  }

  void compare_anchors(const std::vector<SectionLeg>& legs) {
    for (std::size_t i = 0; i < legs.size(); ++i) {
      compare_point(legs[i].base, "base", i);
      compare_point(legs[i].platform, "platform", i);
    }
  }

  /// The certificate has the constants with their tolerances: anchors are expressions of these.
  void compare_uncertain_anchors(Scope stated) {
    std::swap(q_.actual, stated);
    compare_anchors(section_->uncertain_legs(comparer_));
    std::swap(q_.actual, stated);
  }

  void compare_point(const SectionPoint& point, const char* kind, std::size_t leg) {
    const std::size_t axes = q_.solutions->legs.size() == kLegsInPlane ? 2 : 3;
    for (std::size_t axis = 0; axis < axes; ++axis)
      comparer_.compare(comparer_.place_of(point.place + '[' + std::to_string(axis) + ']'),
                        point.value[axis],
                        std::string(kind) + ' ' + std::to_string(leg) + '_' + "xyz"[axis]);
  }

  // An arm.

  void compare_arm(const Scope& scope) {
    require_known_keys();
    q_.variables.empty() ? require_no_tolerances() : require_no_errors();
    const bool is_by_tool = has(motion_ + "tool[0]");
    const bool has_values = name_joints(is_by_tool);
    const SectionArm arm = read_arm(scope);
    const ArmLines& stated = *q_.solutions->arm;
    if (arm.joints.size() != stated.joints.size())
      comparer_.refuse_model("its arm has " + std::to_string(arm.joints.size()) +
                             " joints, and not " + std::to_string(stated.joints.size()));
    for (std::size_t k = 0; k < arm.joints.size(); ++k) compare_joint(arm.joints[k], k);
    if (is_by_tool ? stated.tool.empty() : has_values && !stated.tool.empty())
      require_place_option(is_by_tool ? "the motion gives the place of the tool"
                                      : "the motion gives values of the joints");
    if (!stated.tool.empty()) {
      for (std::size_t k = 0; k < stated.joints.size(); ++k)
        compare_kept(arm.joints[k], stated.joints[k], "joint " + std::to_string(k) + "_15",
                     is_by_tool);
      return compare_tool(arm.tool, is_by_tool);
    }
    std::size_t free = 0;
    for (std::size_t k = 0; k < arm.joints.size(); ++k)
      if (stated.joints[k].held != kNoNode)
        compare_value(arm.joints[k], "joint " + std::to_string(k) + "_15", has_values);
      else
        compare_value(arm.joints[k], "joint-value " + std::to_string(free++), has_values);
  }

  /// `what`: the file says, and not that of the certificate.
  void require_place_option(const std::string& what) {
    if (!comparer_.may_differ(kPlaceOption)) comparer_.refuse_model(what);
    comparer_.note_difference(what + "; the place is that of the certificate");
  }

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
    const FilePlace from = place_of_joint(values_, joint.name);
    const ArmJointLine& stated = q_.solutions->arm->joints[number];
    if (joint.slides != stated.slides)
      comparer_.refuse(from, stated.slides ? "a joint that slides" : "a joint that turns");
    if (stated.held != kNoNode) {
      if (!comparer_.may_differ(kHoldOption)) comparer_.refuse(from, "a joint that is held");
      comparer_.note_difference(joint.name + " keeps its value");
    }
    compare_frame(joint.origin, from, "joint " + std::to_string(number) + '_');
    for (std::size_t i = 0; i < 3; ++i)
      comparer_.compare(from, joint.axis[i],
                        "joint " + std::to_string(number) + '_' + std::to_string(12 + i));
  }

  void compare_frame(const PlacementNodes& frame, const FilePlace& from, const std::string& key) {
    for (std::size_t i = 0; i < 9; ++i)
      comparer_.compare(from, frame.R[i / 3][i % 3], key + std::to_string(i));
    for (std::size_t i = 0; i < 3; ++i)
      comparer_.compare(from, frame.p[i], key + std::to_string(9 + i));
  }

  void compare_value(const SectionJoint& joint, const std::string& key, bool has_values) {
    if (!has_values) return comparer_.note_compared(key);
    const std::string place = motion_ + joint.name;
    comparer_.compare(comparer_.place_of(has(place) ? place : place + "[0]"), joint.value, key,
                      kPlaceOption);
  }

  void compare_tool(const PlacementNodes& tip, bool is_in_file) {
    if (has(motion_ + "tool[6]"))
      comparer_.refuse_model("the motion's tool has more than six numbers");
    compare_frame(tip, {"the frame of the tool", 0, "another"}, "tip ");
    const bool in_degrees = is_arm_in_degrees(values_);
    GraphAlgebra algebra(q_.graph);
    for (std::size_t i = 0; i < 6; ++i) {
      const std::string key = "tool " + std::to_string(i),
                        place = motion_ + "tool[" + std::to_string(i) + ']';
      if (!is_in_file) {
        comparer_.note_compared(key);
        continue;
      }
      if (!has(place)) comparer_.refuse_model("the motion's tool has fewer than six numbers");
      const bool is_in_degrees = i >= 3 && in_degrees;
      const NodeId number = comparer_.constant_at(place, is_in_degrees);
      comparer_.compare(comparer_.place_of(place), is_in_degrees ? algebra.degrees(number) : number,
                        key, kPlaceOption);
    }
  }

  // A platform.

  void compare_lengths(const std::vector<SectionLeg>& legs) {
    require_known_keys();
    if (q_.variables.empty()) require_no_tolerances();
    const std::string lengths = motion_ + "legs";
    if (has(lengths + "[0]")) return compare_given_lengths(lengths, legs.size());
    Scope pose = q_.actual;
    for (const SectionPose& p : section_->pose()) {
      const NodeId value = pose[p.name] = value_of(p.name);
      if (value == kNoNode) return accept_place(p.name, legs.size());
    }
    for (std::size_t i = 0; i < legs.size(); ++i) {
      const NodeId square = section_->squared_length(legs[i], pose, comparer_);
      comparer_.expect_defined({motion_, 0, ""}, square);
      compare_square({q_.motion, 0, "leg " + std::to_string(i + 1)}, square, i);
    }
    compare_errors_of_pose(legs, pose);
  }

  // Errors. A squared length may be stated with a larger one.

  /// Returns what the certificate states; 0 if it has none.
  NodeId error_of_square(std::size_t leg) {
    const std::string key = "square-spread " + std::to_string(leg);
    comparer_.note_compared(key);
    const auto found = q_.stated.find(key);
    return found == q_.stated.end() ? q_.graph.number("0") : found->second.node;
  }

  /// `excess`: of what the certificate states over what the file needs, for the ends of variables.
  void require_error(const FilePlace& from, std::size_t leg, NodeId excess,
                     const std::vector<Ball>& variables) {
    if (is_zero_number(q_.graph, excess)) return;
    const auto value = evaluate(q_.graph, {excess}, variables, kBits);
    if (!value) throw Unfinished("an error of " + q_.motion + " has no certain value");
    if (arb_is_nonnegative((*value)[0].get()) == 0)
      comparer_.refuse(from, "a smaller error of leg " + std::to_string(leg + 1));
  }

  /// With ρ ± e the square is within 2ρe + e² of ρ².
  void compare_errors_of_lengths(std::size_t count) {
    if (q_.variables.empty()) return;
    const Scope none;
    GraphAlgebra algebra(q_.graph);
    for (std::size_t i = 0; i < count; ++i) {
      const std::string all = motion_ + "error.legs", own = all + '[' + std::to_string(i) + ']',
                        place = has(all) ? all : own;
      const NodeId stated = error_of_square(i);
      if (!has(place)) continue;
      const NodeId error = comparer_.expression_at(place, none),
                   square = q_.stated.at("square " + std::to_string(i)).node;
      require_error(comparer_.place_of(place), i, error, {});  // not negative
      const NodeId twice = algebra.product(algebra.number(2), algebra.root(square)),
                   needed = algebra.product(error, algebra.sum(twice, error));
      require_error(comparer_.place_of(place), i, algebra.difference(stated, needed), {});
    }
  }

  /// The squares at all poses within the errors. The errors are variables after those of the question.
  void compare_errors_of_pose(const std::vector<SectionLeg>& legs, Scope pose) {
    if (q_.variables.empty()) return;
    GraphAlgebra algebra(q_.graph);
    std::vector<Ball> variables(q_.variables.size());
    FilePlace from{motion_ + "error", 0, ""};
    for (const SectionPose& p : section_->pose()) {
      const std::string place = motion_ + "error." + p.name;
      if (!has(place)) continue;
      from = comparer_.place_of(place);
      const NodeId variable = q_.graph.add(Op::kVariable, int(variables.size()));
      const auto error = evaluate(q_.graph, {comparer_.number_at(place, p.name)}, variables, kBits);
      if (!error) throw Unfinished(place + " has no certain value");
      const double most = mag((*error)[0].enclosure());
      variables.emplace_back(Interval{-most, most}, kBits);
      NodeId& value = pose.at(p.name);
      value = algebra.sum(value, variable);
    }
    for (std::size_t i = 0; i < legs.size(); ++i) {
      const NodeId stated = error_of_square(i),
                   nominal = q_.stated.at("square " + std::to_string(i)).node;
      if (variables.size() == q_.variables.size()) continue;
      const NodeId change =
          algebra.difference(section_->squared_length(legs[i], pose, comparer_), nominal);
      require_error(from, i, algebra.difference(stated, change), variables);
      require_error(from, i, algebra.sum(stated, change), variables);
    }
  }

  void compare_given_lengths(const std::string& list, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::string place = list + '[' + std::to_string(i) + ']';
      if (!has(place)) comparer_.refuse_model("the motion has fewer lengths than there are legs");
      const NodeId length = comparer_.expression_at(place, {});
      const FilePlace from = comparer_.place_of(place);
      comparer_.expect_defined(from, length);
      comparer_.refuse_negative(from, length);
      compare_square(from, GraphAlgebra(q_.graph).square(length), i);
    }
    compare_errors_of_lengths(count);
    if (has(list + '[' + std::to_string(count) + ']'))
      comparer_.refuse_model("the motion has more lengths than there are legs");
  }

  void compare_square(const FilePlace& from, NodeId square, std::size_t leg) {
    comparer_.compare(from, square, "square " + std::to_string(leg), kPlaceOption);
  }

  /// The file has no such place: an option may have given it.
  void accept_place(const std::string& lacking, std::size_t legs) {
    const bool is_known = starts(values_.lower_bound(motion_), motion_);
    require_place_option(is_known ? "the motion '" + q_.motion + "' gives no value of " + lacking
                                  : "the file has no motion '" + q_.motion + '\'');
    for (std::size_t i = 0; i < legs; ++i) comparer_.note_compared("square " + std::to_string(i));
    // The errors of a pose that an option has given cannot be compared with those of the motion.
    const auto error = values_.lower_bound(motion_ + "error.");
    if (starts(error, motion_ + "error.") && !error->first.starts_with(motion_ + "error.legs"))
      comparer_.leave_out(comparer_.place_of(error->first), "the file does not give the pose");
    compare_errors_of_lengths(legs);
  }

  /// Postures are without control errors.
  void require_no_errors() {
    for (const auto& [place, value] : values_)
      if (place.starts_with(motion_ + "error") && !is_zero(value))
        comparer_.leave_out(comparer_.place_of(place), "the claim is without control errors");
  }

  static bool is_zero(const WrittenValue& value) {
    return !value.is_string && !value.text.empty() &&
           value.text.find_first_not_of("0.") == std::string::npos;
  }

  /// The claim is about one platform.
  void require_no_tolerances() {
    for (const auto& [place, value] : values_) {
      const bool is_of_robot = place.starts_with(kGeometry) || place.starts_with("gough.") ||
                               place.starts_with("legs.") || place.starts_with("serial.");
      const bool is_spread = is_of_robot && (place.find("tolerance") != std::string::npos ||
                                             place.find(".radius") != std::string::npos);
      if ((is_spread || place.starts_with(motion_ + "error")) && !is_zero(value))
        comparer_.leave_out(comparer_.place_of(place),
                            "the claim is without tolerances and errors");
    }
  }

  /// A threshold is no part of the claim.
  void require_known_keys() {
    for (auto at = values_.lower_bound(motion_); starts(at, motion_); ++at) {
      const std::string rest = at->first.substr(motion_.size());
      const std::string name = rest.substr(0, rest.find_first_of(".["));
      const auto poses = section_->pose();
      const bool is_pose = std::ranges::any_of(poses, [&](const SectionPose& p) {
        return p.name == name && (rest == name || rest == name + "[0]" || rest == name + "[1]");
      });
      if (!is_pose && name != "legs" && name != "tool" && name != "error" && name != "alpha")
        comparer_.leave_out(comparer_.place_of(at->first), "this reader does not know it");
    }
  }

  QuestionComparer& comparer_;
  Question& q_;
  const WrittenValues& values_;
  SectionReading* const section_;
  const std::string motion_;  ///< "motion.NAME."
};

}  // namespace

void compare_robot_at_place(QuestionComparer& comparer, SectionReading* section) {
  PlaceComparison(comparer, section).run();
}

}  // namespace regulus::verifier
