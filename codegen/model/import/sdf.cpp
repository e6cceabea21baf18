// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/sdf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "codegen/model/import/exact_pose.hpp"
#include "codegen/model/import/read_pose.hpp"
#include "codegen/model/import/sdf_frames.hpp"
#include "codegen/model/names.hpp"
#include "codegen/support/visible_text.hpp"

namespace regulus::detail {
namespace {

/// The model itself, or the first of the world.
XmlElement find_model(const XmlElement& sdf) {
  if (const auto model = sdf.child("model")) return *model;
  for (const XmlElement& world : sdf.children("world"))
    if (const auto model = world.child("model")) return *model;
  sdf.refuse("there is no <model>", "the file must have one");
}

class SdfReader {
 public:
  explicit SdfReader(NumberReader& numbers) : numbers_(numbers), frames_(numbers) {}

  Mechanism read(const XmlElement& sdf) {
    const XmlElement model = find_model(sdf);
    result_.format = "SDF";
    result_.name = model.attribute("name", "robot");
    result_.links.push_back("world");
    refuse_nesting(model);
    for (const XmlElement& link : model.children("link")) read_link(link);
    for (const XmlElement& frame : model.children("frame"))
      frames_.declare(frame, frame.attribute("attached_to", "__model__"));
    for (const XmlElement& joint : model.children("joint")) {
      frames_.declare(joint, child_of(joint));
      types_.emplace(joint.attribute("name"), type_of(joint.attribute("type")));
    }
    for (const XmlElement& element : model.children())
      if (element.name() == "joint")
        read_joint(element);
      else if (element.name() != "link" && element.name() != "frame" && element.name() != "pose")
        ++result_.ignored[visible(element.name())];
    return std::move(result_);
  }

 private:
  static void refuse_nesting(const XmlElement& model) {
    for (const char* name : {"include", "model"})
      if (const auto nested = model.child(name))
        nested->refuse(std::string("<") + name + "> in a model is not supported",
                       "put its links and joints into the model");
  }

  void read_link(const XmlElement& link) {
    frames_.declare(link, "__model__");
    result_.links.push_back(link.required("name"));
    for (const XmlElement& element : link.children())
      if (element.name() != "pose") ++result_.ignored[visible(element.name())];
  }

  static std::string link_name(const XmlElement& joint, const char* role) {
    const auto given = joint.child(role);
    if (!given)
      joint.refuse(fmt::format("joint {} has no <{}>", in_quotes(joint.attribute("name")), role),
                   fmt::format("add <{}>LINK</{}>", role, role));
    // SDF before 1.9 writes it as an attribute in places.
    return given->text().empty() ? given->attribute("link") : given->text();
  }

  static std::string child_of(const XmlElement& joint) {
    std::string child = link_name(joint, "child");
    return child == "world" ? "__model__" : child;
  }

  void read_joint(const XmlElement& element) {
    ImportedJoint joint;
    joint.line = element.line();
    joint.name = element.required("name");
    joint.type_name = element.required("type");
    joint.parent = link_name(element, "parent");
    joint.child = link_name(element, "child");
    for (const std::string& link : {joint.parent, joint.child})
      if (!result_.has_link(link))
        element.refuse("there is no link " + in_quotes(link), "a joint connects two links");
    joint.type = type_of(joint.type_name);
    // The frame of the joint, and then that of the child, as MJCF has a joint off the body's origin.
    const Placement& frame = frames_.placement(joint.name, element);
    joint.origin = pose_of(compose(inverse(link_frame(joint.parent, element)), frame));
    const Pose behind = pose_of(compose(inverse(frame), link_frame(joint.child, element)));
    if (joint.type == JointType::kRevolute || joint.type == JointType::kContinuous ||
        joint.type == JointType::kPrismatic)
      read_axis(element, joint);
    add(joint, behind);
  }

  void add(ImportedJoint joint, const Pose& behind) {
    if (behind.is_identity()) return result_.joints.push_back(std::move(joint));
    ImportedJoint fixed;
    fixed.name = joint.name + "_to_" + joint.child;
    fixed.type_name = "fixed";
    fixed.child = joint.child;
    fixed.parent = joint.child = joint.name + "_frame";
    while (result_.has_link(joint.child)) fixed.parent = joint.child += "_";
    fixed.origin = behind;
    fixed.line = joint.line;
    result_.links.push_back(joint.child);
    result_.joints.push_back(std::move(joint));
    result_.joints.push_back(std::move(fixed));
  }

  const Placement& link_frame(const std::string& link, const XmlElement& user) {
    return frames_.placement(link == "world" ? "__model__" : link, user);
  }

  static JointType type_of(const std::string& name) {
    if (name == "revolute") return JointType::kRevolute;
    if (name == "continuous") return JointType::kContinuous;
    if (name == "prismatic") return JointType::kPrismatic;
    return name == "fixed" ? JointType::kFixed : JointType::kOther;
  }

  void read_axis(const XmlElement& element, ImportedJoint& joint) {
    const auto axis = element.child("axis");
    if (!axis)
      element.refuse("joint " + in_quotes(joint.name) + " has no <axis>",
                     "add <axis><xyz>0 0 1</xyz></axis>");
    const XmlPlace place = axis->place("the axis of joint " + in_quotes(joint.name));
    if (const auto xyz = axis->child("xyz")) {
      joint.axis = read_direction(xyz->text(), place, numbers_);
      if (const std::string other = xyz->attribute("expressed_in"); !other.empty())
        turn_axis(joint, frames_.placement(other, element), element);
    }
    if (const auto old = axis->child("use_parent_model_frame");
        old && old->text() != "0" && old->text() != "false")
      turn_axis(joint, frames_.placement("__model__", element), element);
    if (const auto mimic = axis->child("mimic")) read_mimic(*mimic, joint);
    read_limits(*axis, joint);
  }

  /// multiplier · (q − reference) + offset, q being the value of the other joint.
  void read_mimic(const XmlElement& mimic, ImportedJoint& joint) {
    joint.mimics = mimic.required("joint");
    if (mimic.attribute("axis", "axis") != "axis") return;  // the second axis of a joint of two
    const std::string of = " of the mimic of joint " + in_quotes(joint.name);
    const auto number = [&](const char* name, JointType type) {
      const auto given = mimic.child(name);
      if (!given) return whole(0);
      const std::string word = one_word(given->text());
      const XmlPlace place = given->place(name + of);
      return type == JointType::kPrismatic ? numbers_.length(word, place)
                                           : numbers_.angle(word, AngleUnit::kRadian, place);
    };
    FollowingRule& rule = joint.rule.emplace();
    if (const auto given = mimic.child("multiplier"))
      rule.multiplier =
          numbers_.component(one_word(given->text()), given->place("multiplier" + of));
    const auto leader = types_.find(*joint.mimics);
    const WrittenNumber reference =
        number("reference", leader == types_.end() ? joint.type : leader->second);
    rule.offset = number("offset", joint.type);
    if (!reference.is_zero())
      rule.offset = number_of(rule.offset.value - rule.multiplier.value * reference.value);
  }

  /// Returns the text without white space around it.
  static std::string one_word(const std::string& text) {
    const auto words = words_of(text);
    return words.size() == 1 ? std::string(words.front()) : text;
  }

  /// From another frame into that of the joint.
  void turn_axis(ImportedJoint& joint, const Placement& from, const XmlElement& element) {
    const Placement& frame = frames_.placement(joint.name, element);
    const Point given = {joint.axis[0].value, joint.axis[1].value, joint.axis[2].value};
    const Point turned = reduced(transposed_times(frame.R, times(from.R, given)));
    for (std::size_t i = 0; i < 3; ++i) joint.axis[i] = number_of(turned[i]);
  }

  void read_limits(const XmlElement& axis, ImportedJoint& joint) {
    const auto limit = axis.child("limit");
    if (!limit || joint.type == JointType::kContinuous) return;
    const auto lower = limit->child("lower"), upper = limit->child("upper");
    if (!lower || !upper) return;
    // SDF writes ±1e16 or ±inf for no limit.
    for (const auto& end : {lower, upper})
      if (end->text().find("inf") != std::string::npos ||
          end->text().find("e+16") != std::string::npos ||
          end->text().find("1e16") != std::string::npos) {
        if (joint.type == JointType::kRevolute) joint.type = JointType::kContinuous;
        return;
      }
    const XmlPlace place = limit->place("the limit of joint " + in_quotes(joint.name));
    const auto number = [&](const std::string& text) {
      const std::string word = one_word(text);
      return joint.type == JointType::kPrismatic ? numbers_.length(word, place)
                                                 : numbers_.angle(word, AngleUnit::kRadian, place);
    };
    joint.limits = JointLimits{number(lower->text()), number(upper->text())};
    if (joint.limits->lower.approx() > joint.limits->upper.approx())
      limit->refuse(place.what + " has its lower end above the upper one", "exchange them");
  }

  NumberReader& numbers_;
  SdfFrames frames_;
  std::map<std::string, JointType> types_;  ///< of the joints, by name
  Mechanism result_;
};

}  // namespace

Mechanism read_sdf(const XmlElement& sdf, NumberReader& numbers) {
  return SdfReader(numbers).read(sdf);
}

}  // namespace regulus::detail
