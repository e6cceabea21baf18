// SPDX-License-Identifier: GPL-3.0-or-later
// The robot files of this folder, and their kinematics by a reader of its own.
#pragma once

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/serial/forward_kinematics.hpp"

namespace regulus::detail::test {

inline std::string robot_path(const std::string& file) {
  return std::string(REGULUS_SOURCE_DIR "/tests/support/robots/") + file;
}

inline std::string robot_text(const std::string& file) {
  std::ifstream stream(robot_path(file));
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline const std::vector<std::string>& arm_names() {
  static const std::vector<std::string> names = {"crx10ial",    "iiwa14", "irb2400", "kr16_2",
                                                 "lrmate200id", "mh5",    "panda",   "rx160",
                                                 "sia20d",      "ur5e"};
  return names;
}

/// The chain of a URDF file of this folder up to its last joint that moves, with regular
/// expressions and doubles.
inline std::vector<ChainJoint> urdf_chain(const std::string& text) {
  const auto value = [](const std::string& part, const std::string& pattern) {
    std::smatch match;
    return std::regex_search(part, match, std::regex(pattern)) ? match[1].str() : std::string();
  };
  const auto vector = [](const std::string& words, Vec otherwise) {
    std::istringstream stream(words);
    if (!words.empty())
      for (double& x : otherwise) stream >> x;
    return otherwise;
  };
  struct Named {
    std::string parent;
    ChainJoint joint;
  };
  std::map<std::string, Named> by_child;
  const std::regex pattern("<joint name=\"[^\"]*\" type=\"([a-z]*)\">([^]*?)</joint>");
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at) {
    const std::string type = (*at)[1], part = (*at)[2];
    ChainJoint joint{.axis = vector(value(part, "axis xyz=\"([^\"]*)\""), {1, 0, 0}),
                     .moves = type != "fixed",
                     .slides = type == "prismatic"};
    joint.origin = {of_rpy(vector(value(part, "rpy=\"([^\"]*)\""), {})),
                    vector(value(part, "origin [^>]*xyz=\"([^\"]*)\""), {})};
    by_child[value(part, "child link=\"([^\"]*)\"")] = {value(part, "parent link=\"([^\"]*)\""),
                                                        joint};
  }
  std::vector<ChainJoint> longest;
  for (const auto& [child, named] : by_child) {
    std::vector<ChainJoint> chain;
    for (auto at = by_child.find(child); at != by_child.end();
         at = by_child.find(at->second.parent))
      chain.insert(chain.begin(), at->second.joint);
    while (!chain.empty() && !chain.back().moves) chain.pop_back();
    const auto moving = [](const auto& c) {
      return std::ranges::count(c, true, &ChainJoint::moves);
    };
    if (moving(chain) > moving(longest)) longest = chain;
  }
  return longest;
}

}  // namespace regulus::detail::test
