// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the kinematics of a URDF file and of the list of closures beside it, with none of the code
// under test: no more than what files of robots with loops have.
#pragma once

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/loops/file_robot.hpp"

namespace regulus::detail::test {

inline std::string text_of_file(const std::string& path) {
  std::ifstream stream(path);
  if (!stream) throw std::invalid_argument("there is no file " + path);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// The value of an attribute in a tag; "" without it.
inline std::string attribute_of(const std::string& tag, const std::string& name) {
  for (std::size_t at = tag.find(name + "="); at != std::string::npos;
       at = tag.find(name + "=", at + 1)) {
    if (at > 0 && tag[at - 1] != ' ' && tag[at - 1] != '\n' && tag[at - 1] != '\t') continue;
    const char quote = tag[at + name.size() + 1];
    const std::size_t begin = at + name.size() + 2;
    return tag.substr(begin, tag.find(quote, begin) - begin);
  }
  return "";
}

inline Vec vector_of(const std::string& text, const Vec& otherwise) {
  if (text.empty()) return otherwise;
  Vec v{};
  std::istringstream words(text);
  for (double& x : v) {
    std::string word;  // streams refuse numbers that are below the least normal one
    words >> word;
    x = std::strtod(word.c_str(), nullptr);
  }
  return v;
}

/// The tag that begins with "<NAME" in an element; "" without it.
inline std::string tag_of(const std::string& element, const std::string& name) {
  const std::size_t at = element.find("<" + name + " ");
  return at == std::string::npos ? "" : element.substr(at, element.find('>', at) - at);
}

inline FileJoint joint_of(const std::string& element) {
  const std::string head = element.substr(0, element.find('>'));
  FileJoint joint;
  joint.name = attribute_of(head, "name");
  const std::string type = attribute_of(head, "type");
  joint.moves = type == "fixed"                              ? Moves::kNot
                : type == "revolute" || type == "continuous" ? Moves::kTurns
                : type == "prismatic"                        ? Moves::kSlides
                : type == "spherical"                        ? Moves::kAsABall
                                      : throw std::invalid_argument("the joint type " + type);
  joint.parent = attribute_of(tag_of(element, "parent"), "link");
  joint.child = attribute_of(tag_of(element, "child"), "link");
  const std::string origin = tag_of(element, "origin");
  joint.origin = {of_rpy(vector_of(attribute_of(origin, "rpy"), {})),
                  vector_of(attribute_of(origin, "xyz"), {})};
  joint.axis = vector_of(attribute_of(tag_of(element, "axis"), "xyz"), {1, 0, 0});
  if (element.find("<mimic") != std::string::npos)
    throw std::invalid_argument("joints that follow others");
  return joint;
}

/// The words of the value of a key, whatever brackets and quotes are around them.
inline std::vector<std::string> listed(const std::string& list, const std::string& key) {
  std::size_t at = list.find(key + ":");
  if (at == std::string::npos) return {};
  at += key.size() + 1;
  std::vector<std::string> words;
  std::string word;
  for (int depth = 0; at < list.size(); ++at) {
    const char c = list[at];
    depth += c == '[' ? 1 : c == ']' ? -1 : 0;
    const bool is_letter = std::string("[]',\" \n\r\t").find(c) == std::string::npos;
    if (is_letter) word += c;
    if (!is_letter && !word.empty()) words.push_back(std::move(word)), word.clear();
    if (c == ']' && depth == 0) break;
  }
  return words;
}

/// A joint that turns about one axis and then about another.
inline void make_universal(FileRobot& robot, std::size_t at, const std::string& axes) {
  const auto axis = [](char letter) {
    Vec v{};
    v.at(std::size_t(letter - 'X')) = 1;
    return v;
  };
  FileJoint second = robot.joints[at];
  robot.joints[at].axis = axis(axes[0]);
  robot.joints[at].child += " between";
  second.name += "_2";
  second.parent = robot.joints[at].child;
  second.origin = {};
  second.axis = axis(axes[1]);
  robot.joints.push_back(second);
}

/// The link of a name, or the one behind the joint of that name.
inline std::string link_named(const FileRobot& robot, const std::string& name) {
  for (const FileJoint& joint : robot.joints)
    if (joint.parent == name || joint.child == name) return name;
  for (const FileJoint& joint : robot.joints)
    if (joint.name == name) return joint.child;
  throw std::invalid_argument("there is no link " + name);
}

/// Reads `FOLDER/robot.urdf` and `FOLDER/robot.yaml`.
inline FileRobot robot_in(const std::string& folder) {
  FileRobot robot;
  const std::string text = text_of_file(folder + "/robot.urdf");
  const std::string list = text_of_file(folder + "/robot.yaml");
  for (std::size_t at = text.find("<joint "); at != std::string::npos;) {
    const std::size_t end = text.find("</joint>", at);
    robot.joints.push_back(joint_of(text.substr(at, end - at)));
    at = text.find("<joint ", end);
  }
  const std::vector<std::string> names = listed(list, "joint_name");
  const std::vector<std::string> types = listed(list, "joint_type");
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t j = 0; j < robot.joints.size(); ++j)
      if (robot.joints[j].name == names[i]) {
        if (types.at(i) == "SPHERICAL")
          robot.joints[j].moves = Moves::kAsABall;
        else
          make_universal(robot, j, types.at(i).substr(7));
        break;
      }
  const std::vector<std::string> pairs = listed(list, "closed_loop"), kinds = listed(list, "type");
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2)
    robot.loops.push_back({link_named(robot, pairs[i]),
                           link_named(robot, pairs[i + 1]),
                           {},
                           {},
                           kinds.at(i / 2) == "6d"});
  robot.motors = listed(list, "name_mot");
  robot.order();
  return robot;
}

}  // namespace regulus::detail::test
