// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/mjcf.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "codegen/model/import/mjcf_defaults.hpp"
#include "codegen/model/import/read_pose.hpp"
#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/visible_text.hpp"

namespace regulus::detail {
namespace {

class MjcfReader {
 public:
  MjcfReader(const XmlElement& mujoco, NumberReader& numbers)
      : numbers_(numbers), defaults_(mujoco) {}

  Mechanism read(const XmlElement& mujoco) {
    result_.format = "MJCF";
    result_.name = mujoco.attribute("model", "robot");
    for (const XmlElement& compiler : mujoco.children("compiler")) read_compiler(compiler);
    result_.links.push_back("world");
    for (const XmlElement& element : mujoco.children()) {
      const std::string name = element.name();
      if (name == "worldbody")
        read_children(element, "world", "");
      else if (name == "include")
        element.refuse("the file includes " + in_quotes(element.attribute("file")),
                       "put the included file in its place");
      else if (name != "equality" && name != "compiler" && name != "default")
        ignore(name);
      if (name == "actuator")
        for (const XmlElement& motor : element.children())
          if (motor.has("joint")) result_.actuated.push_back(motor.attribute("joint"));
    }
    for (const XmlElement& equality : mujoco.children("equality")) read_equality(equality);
    return std::move(result_);
  }

 private:
  void ignore(const std::string& name) { ++result_.ignored[visible(name)]; }

  void read_compiler(const XmlElement& compiler) {
    const std::string angle = compiler.attribute("angle", "degree");
    if (angle != "degree" && angle != "radian")
      compiler.refuse("the angle is " + in_quotes(angle), "it must be degree or radian");
    unit_ = angle == "degree" ? AngleUnit::kDegree : AngleUnit::kRadian;
    if (compiler.attribute("coordinate", "local") != "local")
      compiler.refuse("the coordinates are not local", "convert the file to local coordinates");
    sequence_ = compiler.attribute("eulerseq", "xyz");
    if (sequence_.size() != 3 || sequence_.find_first_not_of("xyzXYZ") != std::string::npos)
      compiler.refuse("the sequence of Euler angles is " + in_quotes(sequence_),
                      "it has three letters of xyz or XYZ");
    limits_by_range_ = compiler.attribute("autolimits", "true") == "true";
  }

  /// Reads bodies, and frames around them.
  void read_children(const XmlElement& parent, const std::string& link,
                     const std::string& body_class) {
    for (const XmlElement& element : parent.children()) {
      const std::string name = element.name();
      if (name == "body")
        read_body(element, link, element.attribute("childclass", body_class));
      else if (name == "frame")
        read_frame(element, link, element.attribute("childclass", body_class));
      else if (name == "replicate" || name == "attach" || name == "composite" ||
               name == "flexcomp" || name == "include")
        element.refuse("<" + name + "> is not supported", "write the bodies that it stands for");
      else if (name != "joint" && name != "freejoint")
        ignore(name);
    }
  }

  void read_frame(const XmlElement& frame, const std::string& link, const std::string& body_class) {
    for (const char* joint : {"joint", "freejoint"})
      if (frame.child(joint))
        frame.refuse("a joint stands in a <frame>", "write the joint in its body");
    const std::string name =
        add_link(frame.attribute("name", fmt::format("frame_{}", frame.line())));
    add_fixed(frame, link, name, read_pose(frame, name));
    read_children(frame, name, body_class);
  }

  /// Adds a link; an equal name gets a number.
  std::string add_link(const std::string& name) {
    std::string made = name;
    for (int number = 2; !names_.insert(made).second; ++number)
      made = fmt::format("{}_{}", name, number);
    result_.links.push_back(made);
    return made;
  }

  void add_fixed(const XmlElement& element, const std::string& parent, const std::string& child,
                 const Pose& pose) {
    ImportedJoint joint;
    joint.name = child;
    joint.type_name = "fixed";
    joint.parent = parent;
    joint.child = child;
    joint.origin = pose;
    joint.line = element.line();
    result_.joints.push_back(std::move(joint));
  }

  void read_body(const XmlElement& body, const std::string& parent, const std::string& body_class) {
    const std::string given = body.attribute("name", fmt::format("body_{}", body.line()));
    if (names_.contains(given) || given == "world")
      body.refuse("body " + in_quotes(given) + " is there twice", "rename one of them");
    std::vector<XmlElement> joints;
    for (const XmlElement& element : body.children())
      if (element.name() == "joint" || element.name() == "freejoint") joints.push_back(element);
    Pose pose = read_pose(body, given);
    std::string link = parent;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const bool last = i + 1 == joints.size();
      link = add_joint(joints[i], {link, given, last}, pose, body_class);
      pose = {};
    }
    if (joints.empty()) {
      names_.insert(given);
      result_.links.push_back(given);
      add_fixed(body, link, given, pose);
      link = given;
    }
    read_children(body, given, body_class);
  }

  struct Between {
    std::string parent, body;
    bool last;  ///< of the body's joints
  };

  /// A joint turns about its own point of the body: the frame goes there and back. Returns the link
  /// behind the joint.
  std::string add_joint(const XmlElement& element, const Between& between, const Pose& pose,
                        const std::string& body_class) {
    ImportedJoint joint = read_joint(element, between.body, body_class);
    Pose anchor;
    if (const std::string pos = value(element, body_class, "pos"); !pos.empty())
      anchor.xyz =
          read_vector(pos, element.place("pos of joint " + in_quotes(joint.name)), numbers_);
    std::string parent = between.parent;
    const bool offset = !anchor.is_identity();
    if (offset) {
      const std::string before = add_link(between.body + "_before_" + joint.name);
      add_fixed(element, parent, before, pose);
      parent = before;
    }
    joint.origin = offset ? anchor : pose;
    joint.parent = parent;
    const std::string end =
        between.last && !offset ? between.body : between.body + "_behind_" + joint.name;
    joint.child = add_link(end);
    result_.joints.push_back(joint);
    if (!offset) return joint.child;
    for (WrittenNumber& x : anchor.xyz) x = negated(x);
    const std::string behind =
        add_link(between.last ? between.body : between.body + "_at_" + joint.name);
    add_fixed(element, joint.child, behind, anchor);
    return behind;
  }

  std::string value(const XmlElement& joint, const std::string& body_class, const char* key) const {
    return defaults_.attribute(joint, body_class, key);
  }

  ImportedJoint read_joint(const XmlElement& element, const std::string& body,
                           const std::string& body_class) {
    ImportedJoint joint;
    joint.line = element.line();
    joint.name = element.attribute("name", body + "_joint");
    if (!joint_names_.insert(joint.name).second) {
      if (element.has("name"))
        element.refuse("joint " + in_quotes(joint.name) + " is there twice", "rename one of them");
      do joint.name = fmt::format("{}_{}", joint.name, element.line());
      while (!joint_names_.insert(joint.name).second);
    }
    const std::string type =
        element.name() == "freejoint" ? "free" : value(element, body_class, "type");
    joint.type_name = type.empty() ? "hinge" : type;
    if (joint.type_name != "hinge" && joint.type_name != "slide") {
      joint.type = JointType::kOther;
      if (is_limited(element, body_class))
        result_.notes.push_back(
            fmt::format("the range of {} is not read: it is no joint that turns "
                        "about an axis or slides",
                        in_quotes(joint.name)));
      return joint;
    }
    joint.type = joint.type_name == "slide" ? JointType::kPrismatic : JointType::kContinuous;
    const XmlPlace place = element.place("the axis of joint " + in_quotes(joint.name));
    if (const std::string axis = value(element, body_class, "axis"); !axis.empty())
      joint.axis = read_direction(axis, place, numbers_);
    read_limits(element, body_class, joint);
    refuse_reference(element, body_class, joint);
    return joint;
  }

  bool is_limited(const XmlElement& element, const std::string& body_class) const {
    const std::string limited = value(element, body_class, "limited");
    return !value(element, body_class, "range").empty() &&
           (limited == "true" || ((limited.empty() || limited == "auto") && limits_by_range_));
  }

  void read_limits(const XmlElement& element, const std::string& body_class, ImportedJoint& joint) {
    if (!is_limited(element, body_class)) return;
    const std::string range = value(element, body_class, "range");
    const XmlPlace place = element.place("the range of joint " + in_quotes(joint.name));
    const auto ends = joint.type == JointType::kPrismatic ? numbers_.lengths(range, place)
                                                          : numbers_.angles(range, unit_, place);
    if (ends.size() != 2 || ends[0].approx() > ends[1].approx())
      element.refuse(place.what + " is " + in_quotes(range), "write a lower and an upper end");
    joint.limits = JointLimits{ends[0], ends[1]};
    if (joint.type == JointType::kContinuous) joint.type = JointType::kRevolute;
  }

  /// With a reference, the joint's zero is not the pose that the file draws.
  void refuse_reference(const XmlElement& element, const std::string& body_class,
                        const ImportedJoint& joint) {
    const std::string ref = value(element, body_class, "ref");
    const XmlPlace place = element.place("ref of joint " + in_quotes(joint.name));
    if (!ref.empty() && !exact_number(ref, place).is_zero())
      element.refuse("joint " + in_quotes(joint.name) + " has a reference, " + in_quotes(ref),
                     "draw the body with the joint at zero, and remove ref");
  }

  Pose read_pose(const XmlElement& element, const std::string& name) {
    Pose pose;
    const auto place = [&](const char* key) {
      return element.place(fmt::format("{} of body {}", key, in_quotes(name)));
    };
    if (element.has("pos"))
      pose.xyz = read_vector(element.attribute("pos"), place("pos"), numbers_);
    int orientations = 0;
    for (const char* key : {"quat", "euler", "axisangle", "xyaxes", "zaxis"})
      orientations += element.has(key) ? 1 : 0;
    if (orientations > 1)
      element.refuse("body " + in_quotes(name) + " has more than one orientation", "keep one");
    if (element.has("quat"))
      set_quaternion(pose, element.attribute("quat"), place("quat"), numbers_);
    if (element.has("euler"))
      set_euler(pose, element.attribute("euler"), {unit_, sequence_}, place("euler"), numbers_);
    if (element.has("axisangle"))
      set_axis_angle(pose, element.attribute("axisangle"), unit_, place("axisangle"), numbers_);
    if (element.has("xyaxes"))
      set_axes(pose, element.attribute("xyaxes"), place("xyaxes"), numbers_);
    if (element.has("zaxis"))
      set_z_axis(pose, element.attribute("zaxis"), place("zaxis"), numbers_);
    return pose;
  }

  void read_equality(const XmlElement& equality) {
    for (const XmlElement& element : equality.children()) {
      if (element.attribute("active", "true") == "false") continue;
      const std::string name = element.name();
      if (name == "joint")
        follow(element);
      else if (name == "connect" || name == "weld")
        add_loop(element);
      else
        leave_out(element);
    }
  }

  void leave_out(const XmlElement& element) {
    const std::string name = "equality " + element.name();
    ignore(name);
    result_.notes.push_back(
        fmt::format("line {}: {} is not read; the robot moves as if it were not there",
                    element.line(), visible(name)));
  }

  void follow(const XmlElement& element) {
    const std::string first = element.required("joint1");
    const auto joint = std::ranges::find(result_.joints, first, &ImportedJoint::name);
    if (joint == result_.joints.end())
      element.refuse("there is no joint " + in_quotes(first), "correct the name");
    if (joint->mimics)
      element.refuse("joint " + in_quotes(first) + " follows two joints",
                     "keep one equality of it");
    joint->mimics = element.attribute("joint2", "a constant");
    joint->rule.reset();
    if (element.has("joint2")) read_rule(element, *joint);
  }

  /// q1 = a0 + a1*q2 + a2*q2^2 + …, of joints without `ref`; in rad, whatever the compiler's unit.
  void read_rule(const XmlElement& element, ImportedJoint& joint) {
    const XmlPlace place = element.place("polycoef of joint " + in_quotes(joint.name));
    const std::string text = element.attribute("polycoef", "0 1 0 0 0");
    const std::vector<std::string_view> words = words_of(text);
    for (std::size_t i = 2; i < words.size(); ++i)
      if (!numbers_.component(words[i], place).is_zero()) return;
    FollowingRule rule;
    if (words.size() > 1) rule.multiplier = numbers_.component(words[1], place);
    if (!words.empty())
      rule.offset = joint.type == JointType::kPrismatic
                        ? numbers_.length(words[0], place)
                        : numbers_.angle(words[0], AngleUnit::kRadian, place);
    joint.rule = std::move(rule);
  }

  /// The second body in the frame of the first; a quaternion of zeros stands for the zero pose.
  std::optional<Pose> relative_pose(const std::string& text, const XmlPlace& place) {
    const std::vector<std::string_view> words = words_of(text);
    if (words.size() != 7)
      throw InputError::statement(place.file, place.line, "relpose has not seven numbers",
                                  "write three coordinates and a quaternion");
    const auto joined = [&words](std::size_t begin, std::size_t end) {
      return fmt::format("{}", fmt::join(words.begin() + std::ptrdiff_t(begin),
                                         words.begin() + std::ptrdiff_t(end), " "));
    };
    bool is_zero = true;
    for (std::size_t i = 3; i < 7; ++i)
      is_zero = is_zero && numbers_.component(words[i], place).is_zero();
    if (is_zero) return std::nullopt;
    Pose pose;
    pose.xyz = read_vector(joined(0, 3), place, numbers_);
    set_quaternion(pose, joined(3, 7), place, numbers_);
    return pose;
  }

  void add_loop(const XmlElement& element) {
    if (element.has("site1"))
      element.refuse("the loop is closed by sites", "write body1, body2 and anchor");
    ImportedLoop loop{element.name(),
                      element.required("body1"),
                      element.attribute("body2", "world"),
                      {},
                      false,
                      element.line(),
                      {}};
    for (const std::string& link : {loop.first, loop.second})
      if (!result_.has_link(link))
        element.refuse("there is no body " + in_quotes(link), "correct the name");
    if (const std::string relative = element.attribute("relpose");
        loop.type == "weld" && !relative.empty())
      loop.relative = relative_pose(relative, element.place("relpose"));
    if (element.has("anchor") && loop.type == "connect")
      loop.anchor = read_vector(element.attribute("anchor"), element.place("the anchor"), numbers_);
    result_.loops.push_back(std::move(loop));
  }

  NumberReader& numbers_;
  const JointDefaults defaults_;
  Mechanism result_;
  std::set<std::string> names_, joint_names_;
  AngleUnit unit_ = AngleUnit::kDegree;
  std::string sequence_ = "xyz";
  bool limits_by_range_ = true;
};

}  // namespace

Mechanism read_mjcf(const XmlElement& mujoco, NumberReader& numbers) {
  return MjcfReader(mujoco, numbers).read(mujoco);
}

}  // namespace regulus::detail
