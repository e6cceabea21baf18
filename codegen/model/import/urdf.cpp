// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/urdf.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <set>

#include "codegen/model/import/read_pose.hpp"
#include "codegen/model/names.hpp"
#include "codegen/support/visible_text.hpp"

namespace regulus::detail {
namespace {

class UrdfReader {
 public:
  explicit UrdfReader(NumberReader& numbers) : numbers_(numbers) {}

  Mechanism read(const XmlElement& robot) {
    result_.format = "URDF";
    result_.name = robot.attribute("name", "robot");
    for (const XmlElement& element : robot.children())
      if (element.name() == "link") read_link(element);
    for (const XmlElement& element : robot.children()) {
      if (element.name() == "joint")
        read_joint(element);
      else if (element.name() != "link" && element.name() != "constraint")
        ignore_element(element);
    }
    for (const XmlElement& element : robot.children("constraint")) read_constraint(element);
    return std::move(result_);
  }

 private:
  void ignore(const std::string& name) { ++result_.ignored[visible(name)]; }

  /// Definitions that xacro has left over have no effect; a part of the robot may stand for others.
  void ignore_element(const XmlElement& element) {
    const std::string name = element.name();
    const bool is_definition =
        name == "xacro:property" || name == "xacro:arg" || name == "xacro:macro";
    if (name.starts_with("xacro:") && !is_definition)
      element.refuse("<" + visible(name) + "> may stand for links and joints",
                     "expand the macros first: xacro FILE.xacro > FILE.urdf");
    if (name == "transmission")
      for (const XmlElement& joint : element.children("joint"))
        result_.actuated.push_back(joint.attribute("name"));
    ignore(name);
  }

  /// A joint that closes a loop, with its frame in both links.
  void read_constraint(const XmlElement& element) {
    ImportedJoint joint;
    joint.line = element.line();
    joint.name = element.required("name");
    if (!names_.insert(joint.name).second)
      element.refuse("joint " + in_quotes(joint.name) + " is there twice", "rename one of them");
    joint.type_name = one_word(element.required("type"));
    joint.type = type_of(joint.type_name);
    const std::string first = end_of(element, joint, "parent"),
                      second = end_of(element, joint, "child");
    ImportedLoop loop{"weld", first, second, {}, true, joint.line, {}};
    if (joint.type_name == "spherical" || joint.type_name == "ball") {
      loop.type = "connect";
    } else if (joint.type != JointType::kFixed) {
      const bool is_universal = joint.type_name == "universal";
      if (is_universal) joint.type = JointType::kContinuous;
      if (joint.type != JointType::kOther) read_limits(element, joint);
      if (joint.type == JointType::kOther)
        element.refuse("the constraint " + in_quotes(joint.name) + " has the type " +
                           in_quotes(joint.type_name),
                       "it must be fixed, revolute, continuous, prismatic, universal or spherical");
      loop.first = add_constraint_joint(element, joint, first, "parent_axis", "");
      if (is_universal)
        loop.first = add_constraint_joint(element, joint, loop.first, "child_axis", "_2");
    }
    result_.loops.push_back(std::move(loop));
  }

  std::string new_link(const std::string& name) {
    std::string made = name;
    while (result_.has_link(made)) made += "_";
    result_.links.push_back(made);
    return made;
  }

  /// Returns a link at the frame of a constraint in one of its links.
  std::string end_of(const XmlElement& element, const ImportedJoint& of, const std::string& role) {
    ImportedJoint fixed;
    fixed.line = of.line;
    fixed.name = of.name + "_in_" + role;
    fixed.type_name = "fixed";
    fixed.parent = link_of(element, of, role.c_str());
    fixed.child = new_link(fixed.name);
    if (const auto origin = element.child((role + "_origin").c_str()))
      fixed.origin = read_origin(*origin, of);
    result_.joints.push_back(fixed);
    return fixed.child;
  }

  std::string add_constraint_joint(const XmlElement& element, ImportedJoint joint,
                                   const std::string& parent, const char* axis,
                                   const char* suffix) {
    if (*suffix != '\0') {
      do joint.name += suffix;
      while (!names_.insert(joint.name).second);
    }
    joint.parent = parent;
    joint.child = new_link(joint.name + "_moved");
    const auto given = element.child(axis);
    if (!given)
      element.refuse("the constraint " + in_quotes(joint.name) + " has no <" + axis + ">",
                     fmt::format("add <{} xyz=\"0 0 1\"/>", axis));
    joint.axis = read_direction(given->required("xyz"),
                                given->place("the axis of " + in_quotes(joint.name)), numbers_);
    result_.joints.push_back(joint);
    return joint.child;
  }

  void read_link(const XmlElement& link) {
    const std::string name = link.required("name");
    if (result_.has_link(name))
      link.refuse("link " + in_quotes(name) + " is there twice", "rename one of them");
    result_.links.push_back(name);
    for (const XmlElement& element : link.children()) ignore(element.name());
  }

  void read_joint(const XmlElement& element) {
    ImportedJoint joint;
    joint.line = element.line();
    joint.name = element.required("name");
    if (!names_.insert(joint.name).second)
      element.refuse("joint " + in_quotes(joint.name) + " is there twice", "rename one of them");
    joint.type_name = one_word(element.required("type"));
    joint.type = type_of(joint.type_name);
    joint.parent = link_of(element, joint, "parent");
    joint.child = link_of(element, joint, "child");
    if (const auto origin = element.child("origin")) joint.origin = read_origin(*origin, joint);
    if (joint.type != JointType::kFixed && joint.type != JointType::kOther) {
      read_axis(element, joint);
      read_limits(element, joint);
    }
    if (const auto mimic = element.child("mimic")) read_mimic(*mimic, joint);
    for (const char* name : {"dynamics", "calibration", "safety_controller"})
      if (element.child(name)) ignore(name);
    result_.joints.push_back(std::move(joint));
  }

  void read_mimic(const XmlElement& mimic, ImportedJoint& joint) {
    joint.mimics = mimic.required("joint");
    const std::string of = " of the mimic of joint " + in_quotes(joint.name);
    FollowingRule& rule = joint.rule.emplace();
    if (mimic.has("multiplier"))
      rule.multiplier =
          numbers_.component(mimic.attribute("multiplier"), mimic.place("multiplier" + of));
    if (!mimic.has("offset")) return;
    const XmlPlace place = mimic.place("offset" + of);
    rule.offset = joint.type == JointType::kPrismatic
                      ? numbers_.length(mimic.attribute("offset"), place)
                      : numbers_.angle(mimic.attribute("offset"), AngleUnit::kRadian, place);
  }

  /// Returns the text without white space around it.
  static std::string one_word(const std::string& text) {
    const auto words = words_of(text);
    return words.size() == 1 ? std::string(words.front()) : text;
  }

  /// Programs write an infinite limit, or one like 1e16, for none.
  static bool is_unlimited(const std::string& text) {
    const std::string word = one_word(text);
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    return !word.empty() && *end == '\0' && std::fabs(value) >= 1e15;
  }

  static JointType type_of(const std::string& name) {
    if (name == "revolute") return JointType::kRevolute;
    if (name == "continuous") return JointType::kContinuous;
    if (name == "prismatic") return JointType::kPrismatic;
    return name == "fixed" ? JointType::kFixed : JointType::kOther;
  }

  std::string link_of(const XmlElement& element, const ImportedJoint& joint, const char* role) {
    const auto given = element.child(role);
    if (!given)
      element.refuse(fmt::format("joint {} has no <{}>", in_quotes(joint.name), role),
                     fmt::format("add <{} link=\"…\"/>", role));
    std::string link = given->required("link");
    if (!result_.has_link(link)) {
      result_.notes.push_back(fmt::format("line {}: there is no <link> {}; joint {} alone names it",
                                          given->line(), in_quotes(link), in_quotes(joint.name)));
      result_.links.push_back(link);
    }
    return link;
  }

  Pose read_origin(const XmlElement& origin, const ImportedJoint& joint) {
    Pose pose;
    const std::string of = " of joint " + in_quotes(joint.name);
    if (origin.has("xyz"))
      pose.xyz = read_vector(origin.attribute("xyz"), origin.place("xyz" + of), numbers_);
    if (origin.has("quat_xyzw"))
      origin.refuse("the origin" + of + " has quat_xyzw", "write its orientation as rpy");
    if (origin.has("rpy"))
      set_rpy(pose, origin.attribute("rpy"), AngleUnit::kRadian, origin.place("rpy" + of),
              numbers_);
    return pose;
  }

  void read_axis(const XmlElement& element, ImportedJoint& joint) {
    const auto axis = element.child("axis");
    if (!axis) {
      joint.axis = {whole(1), whole(0), whole(0)};
      result_.notes.push_back(fmt::format("line {}: joint {} has no axis, which is 1 0 0 in URDF",
                                          joint.line, in_quotes(joint.name)));
      return;
    }
    const XmlPlace place = axis->place("the axis of joint " + in_quotes(joint.name));
    joint.axis = read_direction(axis->required("xyz"), place, numbers_);
  }

  void read_limits(const XmlElement& element, ImportedJoint& joint) {
    const auto limit = element.child("limit");
    if (joint.type == JointType::kContinuous || !limit) return;
    if (!limit->has("lower") && !limit->has("upper")) return;
    if (is_unlimited(limit->attribute("lower")) || is_unlimited(limit->attribute("upper"))) return;
    const auto end = [&](const char* key) -> WrittenNumber {
      const XmlPlace place =
          limit->place(fmt::format("the {} limit of joint {}", key, in_quotes(joint.name)));
      const std::string text = limit->attribute(key, "0");  // as URDF has it
      const std::string word = one_word(text);
      return joint.type == JointType::kPrismatic ? numbers_.length(word, place)
                                                 : numbers_.angle(word, AngleUnit::kRadian, place);
    };
    joint.limits = JointLimits{end("lower"), end("upper")};
    if (joint.limits->lower.approx() > joint.limits->upper.approx())
      limit->refuse("the lower limit of joint " + in_quotes(joint.name) + " is above the upper one",
                    "exchange them");
  }

  NumberReader& numbers_;
  Mechanism result_;
  std::set<std::string> names_;
};

}  // namespace

Mechanism read_urdf(const XmlElement& robot, NumberReader& numbers) {
  return UrdfReader(numbers).read(robot);
}

}  // namespace regulus::detail
