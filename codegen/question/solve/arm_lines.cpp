// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/arm_lines.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "codegen/answer/certificate/certificate_expression_writer.hpp"
#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/model/degrees.hpp"
#include "codegen/model/mechanism/serial.hpp"
#include "codegen/question/solve/nominal.hpp"
#include "codegen/question/solve/platform_legs.hpp"
#include "codegen/question/solve/turning_tool.hpp"
#include "codegen/question/solve/varying_place.hpp"
#include "runtime/proof/format.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

std::string expressions(const std::vector<ex>& values) {
  std::string text;
  for (const ex& value : values) text += (text.empty() ? "" : " | ") + expression_text(value);
  return text;
}

/// The rotation row by row, and the place.
template <class Stated>
std::vector<ex> numbers_of(const Placement& placement, const Stated& stated) {
  std::vector<ex> numbers;
  for (unsigned i = 0; i < 3; ++i)
    for (unsigned j = 0; j < 3; ++j) numbers.push_back(stated(placement.R(i, j)));
  for (const ex& x : placement.p) numbers.push_back(stated(x));
  return numbers;
}

/// The lines of an arm, in the order in which they are written.
class ArmLines {
 public:
  /// `solutions`: its unknowns are the joints that are free.
  ArmLines(const Request& request, const Solutions& solutions)
      : model_(request.model), request_(request), solutions_(solutions), nominal_(request.model) {
    std::size_t next = 0;
    for (const SerialJoint& joint : model_.arm->joints)
      number_.push_back(joint.follows ? 0 : next++);
  }

  [[nodiscard]] std::string text() const {
    std::string text = varies_ ? geometry_lines(model_, uncertain_names(request_)) : "", values;
    for (std::size_t k = 0; k < model_.arm->joints.size(); ++k) {
      text += joint_line(k);
      if (is_free(k)) values += "joint-value " + expression_text(value_of(k)) + '\n';
    }
    text += range_lines();
    if (!is_by_tool_) return text + values;
    return text + "tip " + expressions(stated(model_.arm->tool)) + "\ntool " +
           expressions(tool_within_errors(request_.motion)) + '\n';
  }

  [[nodiscard]] std::string robot() const {
    return format::describe_arm(
        solutions_.unknowns.size(), is_turn_of_tool(model_, model_.pose.size() - 1),
        std::ranges::any_of(model_.arm->joints,
                            [](const SerialJoint& joint) { return joint.follows.has_value(); }),
        !range_lines().empty());
  }

 private:
  [[nodiscard]] ex stated(const ex& x) const { return varies_ ? x : nominal_.at(x); }
  [[nodiscard]] std::vector<ex> stated(const Placement& frame) const {
    return numbers_of(frame, [this](const ex& x) { return stated(x); });
  }
  [[nodiscard]] const PoseParameter& pose(std::size_t joint) const {
    return model_.pose[number_[joint]];
  }
  [[nodiscard]] bool is_free(std::size_t joint) const {
    return !model_.arm->joints[joint].follows &&
           std::ranges::find(solutions_.unknowns, pose(joint).name, &SolvedUnknown::name) !=
               solutions_.unknowns.end();
  }
  /// In lengths or radians. The tool brings free joints to others.
  [[nodiscard]] ex value_of(std::size_t joint) const {
    const ex unit = is_in_degrees(pose(joint).unit) ? one_degree() : ex(1);
    const std::size_t k = number_[joint];
    return is_by_tool_ && is_free(joint)
               ? ex(0)
               : nominal_.at(values_[k] * unit) + added_to_pose(request_.motion, k);
  }

  [[nodiscard]] std::string joint_line(std::size_t k) const {
    const SerialJoint& joint = model_.arm->joints[k];
    std::vector<ex> numbers = stated(joint.origin);
    if (!joint.follows && is_turn_of_tool(model_, number_[k]))
      return "turning-tool " + expressions(numbers) + '\n';
    for (const ex& x : joint.axis) numbers.push_back(stated(x));
    if (joint.follows)
      numbers.insert(numbers.end(), {ex(static_cast<unsigned long>(joint.follows->leader + 1)),
                                     joint.follows->multiplier, joint.follows->offset});
    else if (!is_free(k))
      numbers.push_back(value_of(k));
    return fmt::format("{}{} {}\n",
                       joint.follows ? "following-"
                       : is_free(k)  ? ""
                                     : "held-",
                       joint.kind == JointKind::kPrismatic ? "sliding-joint" : "joint",
                       expressions(numbers));
  }

  /// Returns a line for each joint that was looked for in a range.
  [[nodiscard]] std::string range_lines() const {
    std::string text;
    for (std::size_t k = 0; k < solutions_.unknowns.size() && solutions_.left_out; ++k) {
      const auto& range = solutions_.unknowns[k].range;
      if (range && std::ranges::find(*solutions_.left_out, k + 1) == solutions_.left_out->end())
        text += fmt::format("joint-range {} in {} : {}\n", k + 1, range->lo, range->hi);
    }
    return text;
  }

  const Model& model_;
  const Request& request_;
  const Solutions& solutions_;
  const NominalGeometry nominal_;
  const bool is_by_tool_ = !request_.motion.tool.empty(), varies_ = has_tolerances(request_);
  const std::vector<ex> values_ = is_by_tool_ ? request_.motion.pose : pose_of(request_.motion);
  std::vector<std::size_t> number_;  ///< by joint: its parameter of the pose, if it follows none
};

}  // namespace

CertifiedArm certified_arm(const Request& request, const Solutions& solutions) {
  const ArmLines arm(request, solutions);
  return {arm.robot(), arm.text()};
}

}  // namespace regulus::detail
