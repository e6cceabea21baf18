// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/mjcf_defaults.hpp"

#include <array>
#include <utility>

#include "codegen/model/names.hpp"

namespace regulus::detail {
namespace {

constexpr std::array<const char*, 7> kJointKeys = {"type",    "axis", "pos",  "range",
                                                   "limited", "ref",  "class"};

}  // namespace

JointDefaults::JointDefaults(const XmlElement& mujoco) {
  classes_["main"] = {};
  for (const XmlElement& element : mujoco.children("default"))
    read(element, element.attribute("class", "main"), classes_["main"]);
}

void JointDefaults::read(const XmlElement& element, const std::string& name, Attributes inherited) {
  for (const XmlElement& joint : element.children("joint"))
    for (const char* key : kJointKeys)
      if (joint.has(key)) inherited[key] = joint.attribute(key);
  classes_[name] = inherited;
  for (const XmlElement& child : element.children("default"))
    read(child, child.required("class"), inherited);
}

std::string JointDefaults::attribute(const XmlElement& joint, const std::string& body_class,
                                     const char* key) const {
  if (joint.has(key)) return joint.attribute(key);
  const std::string name = joint.attribute("class", body_class.empty() ? "main" : body_class);
  const auto found = classes_.find(name);
  if (found == classes_.end())
    joint.refuse("there is no default class " + in_quotes(name), "correct the class");
  const auto value = found->second.find(key);
  return value == found->second.end() ? "" : value->second;
}

}  // namespace regulus::detail
