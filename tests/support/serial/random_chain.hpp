// SPDX-License-Identifier: GPL-3.0-or-later
// Random arms with joints that follow others, written as a model file and as robot files; and their
// forward kinematics, from the same description and with none of the code under test.
#pragma once

#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/random_source.hpp"
#include "tests/support/serial/forward_kinematics.hpp"

namespace regulus::detail::test {

struct RandomFollowing {
  std::size_t leader = 0;
  double multiplier = 1, offset = 0;
};

/// A joint turns about, or slides along, an axis through `anchor` of the frame that it moves.
struct RandomJoint {
  std::string name;
  bool slides = false;
  Vec xyz{}, rpy{}, anchor{}, axis{0, 0, 1};
  std::optional<RandomFollowing> follows{};
};

/// Arms of joints with parallel, crossing and skew axes. Lengths are tenths: exact in all files.
class RandomChain {
 public:
  explicit RandomChain(std::uint64_t seed) : random_(seed) {
    const std::size_t leaders = 2 + random_.below(4), followers = 1 + random_.below(3);
    std::vector<std::size_t> leading;
    for (std::size_t j = 0; j < leaders + followers; ++j) {
      const std::size_t rest = leaders - leading.size();
      const bool leads = leading.empty() || random_.below(leaders + followers - j) < rest;
      if (leads && rest > 0) leading.push_back(j);
      add_joint(j, leads && rest > 0 ? std::nullopt : std::optional(following(leading)));
    }
    // The leader of a joint may come behind it.
    for (RandomJoint& joint : joints_)
      if (joint.follows && random_.one_in(4)) joint.follows->leader = leading.back();
  }

  [[nodiscard]] const std::vector<RandomJoint>& joints() const { return joints_; }

  [[nodiscard]] std::size_t leaders() const {
    std::size_t count = 0;
    for (const RandomJoint& joint : joints_) count += joint.follows ? 0 : 1;
    return count;
  }

  /// `q`: values of the joints that follow none.
  [[nodiscard]] Frame tool(const std::vector<double>& q) const {
    std::vector<double> values(joints_.size());
    std::size_t next = 0;
    for (std::size_t j = 0; j < joints_.size(); ++j)
      if (!joints_[j].follows) values[j] = q[next++];
    for (std::size_t j = 0; j < joints_.size(); ++j)
      if (const auto& rule = joints_[j].follows)
        values[j] = rule->multiplier * values[rule->leader] + rule->offset;
    Frame frame;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const RandomJoint& joint = joints_[j];
      const double length = std::sqrt(inner(joint.axis, joint.axis));
      frame = frame * Frame{of_rpy(joint.rpy), joint.xyz} * Frame{.p = joint.anchor} *
              (joint.slides ? Frame{.p = values[j] / length * joint.axis}
                            : Frame{.R = turn_about(joint.axis, values[j])}) *
              Frame{.p = -1.0 * joint.anchor};
    }
    return frame;
  }

  [[nodiscard]] std::string toml() const {
    std::string text = "regulus = 1\nname = \"arm\"\n[serial]\njoints = [\n", zero;
    for (const RandomJoint& joint : joints_) {
      text += "{ type = \"fixed\", xyz = " + list(joint.xyz) + ", rpy = [";
      for (const double angle : joint.rpy) text += exact_angle(angle) + ", ";
      text += "] },\n{ type = \"" + std::string(joint.slides ? "prismatic" : "revolute") + "\", ";
      if (const auto& rule = joint.follows)
        text += "mimic = \"" + joints_[rule->leader].name +
                "\", multiplier = " + number(rule->multiplier) +
                ", offset = " + exact_angle(rule->offset);
      else
        text += "name = \"" + joint.name + "\"", zero += joint.name + " = 0\n";
      text += ", xyz = " + list(joint.anchor) + ", axis = " + list(joint.axis) +
              " },\n{ type = \"fixed\", xyz = " + list(-1.0 * joint.anchor) + " },\n";
    }
    return text + "]\n[motion.zero]\n" + zero;
  }

  [[nodiscard]] std::string urdf() const {
    std::string text = "<robot name=\"arm\">\n<link name=\"base\"/>\n", parent = "base";
    for (const RandomJoint& joint : joints_) {
      const std::string& n = joint.name;
      for (const char* link : {"_root", "_arm", "_end"})
        text += "<link name=\"" + n + link + "\"/>\n";
      text += "<joint name=\"" + n + "_place\" type=\"fixed\"><parent link=\"" + parent +
              "\"/><child link=\"" + n + "_root\"/><origin xyz=\"" + words(joint.xyz) +
              "\" rpy=\"" + words(joint.rpy) + "\"/></joint>\n<joint name=\"" + n + "\" type=\"" +
              (joint.slides ? "prismatic" : "revolute") + "\"><parent link=\"" + n +
              "_root\"/><child link=\"" + n + "_arm\"/><origin xyz=\"" + words(joint.anchor) +
              "\"/><axis xyz=\"" + words(joint.axis) + "\"/>";
      if (const auto& rule = joint.follows)
        text += "<mimic joint=\"" + joints_[rule->leader].name + "\" multiplier=\"" +
                number(rule->multiplier) + "\" offset=\"" + number(rule->offset) + "\"/>";
      text += "</joint>\n<joint name=\"" + n + "_back\" type=\"fixed\"><parent link=\"" + n +
              "_arm\"/><child link=\"" + n + "_end\"/><origin xyz=\"" + words(-1.0 * joint.anchor) +
              "\"/></joint>\n";
      parent = n + "_end";
    }
    return text + "</robot>\n";
  }

  [[nodiscard]] std::string mjcf() const {
    std::string text =
        "<mujoco model=\"arm\"><compiler angle=\"radian\" eulerseq=\"XYZ\"/>\n<worldbody>\n";
    std::string ends, equality;
    for (const RandomJoint& joint : joints_) {
      text += "<body name=\"" + joint.name + "_body\" pos=\"" + words(joint.xyz) + "\" euler=\"" +
              words(joint.rpy) + "\"><joint name=\"" + joint.name + "\" type=\"" +
              (joint.slides ? "slide" : "hinge") + "\" pos=\"" + words(joint.anchor) +
              "\" axis=\"" + words(joint.axis) + "\"/>\n";
      ends += "</body>";
      if (const auto& rule = joint.follows)
        equality += "<joint joint1=\"" + joint.name + "\" joint2=\"" + joints_[rule->leader].name +
                    "\" polycoef=\"" + number(rule->offset) + " " + number(rule->multiplier) +
                    " 0 0 0\"/>\n";
    }
    return text + ends + "</worldbody>\n<equality>\n" + equality + "</equality></mujoco>\n";
  }

  [[nodiscard]] std::string sdf() const {
    std::string text = "<sdf version=\"1.11\"><model name=\"arm\">\n<link name=\"base\"/>\n";
    std::string parent = "base";
    for (const RandomJoint& joint : joints_) {
      const std::string link = joint.name + "_link";
      text += "<link name=\"" + link + "\"><pose relative_to=\"" + parent + "\">" +
              words(joint.xyz) + " " + words(joint.rpy) + "</pose></link>\n<joint name=\"" +
              joint.name + "\" type=\"" + (joint.slides ? "prismatic" : "revolute") + "\"><pose>" +
              words(joint.anchor) + " 0 0 0</pose><parent>" + parent + "</parent><child>" + link +
              "</child><axis><xyz>" + words(joint.axis) + "</xyz>";
      if (const auto& rule = joint.follows)
        text += "<mimic joint=\"" + joints_[rule->leader].name + "\"><multiplier>" +
                number(rule->multiplier) + "</multiplier><offset>" + number(rule->offset) +
                "</offset><reference>0</reference></mimic>";
      text += "</axis></joint>\n";
      parent = link;
    }
    return text + "</model></sdf>\n";
  }

 private:
  static constexpr double kSixtieth = std::numbers::pi / 60, kTwelfth = 5 * kSixtieth;

  static std::string number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.15g", value);
    return text;
  }
  static std::string words(const Vec& v) {
    return number(v[0]) + " " + number(v[1]) + " " + number(v[2]);
  }
  static std::string list(const Vec& v) {
    return "[" + number(v[0]) + ", " + number(v[1]) + ", " + number(v[2]) + "]";
  }
  static std::string exact_angle(double value) {
    const double k = std::round(value / kSixtieth);
    return k != 0 && std::fabs(k * kSixtieth - value) < 1e-12
               ? "\"" + std::to_string(int(k)) + "*pi/60\""
               : number(value);
  }

  double tenths() { return (double(random_.below(11)) - 5) / 10; }

  RandomFollowing following(const std::vector<std::size_t>& leading) {
    constexpr double kMultipliers[] = {-1, -1, -1, 0, 1, 0.5, -0.5, 2};
    const double offsets[] = {0, 0, 0, 6 * kTwelfth, -4 * kTwelfth, 0.3};
    return {leading[random_.below(leading.size())], kMultipliers[random_.below(8)],
            offsets[random_.below(6)]};
  }

  Vec random_rpy() {
    Vec rpy{};
    switch (random_.below(6)) {
      case 0:
        // Twelfths and tenths of half a turn: their sines may be roots.
        rpy[random_.below(3)] =
            kSixtieth * double(random_.one_in(2) ? 5 * random_.below(24) : 6 * random_.below(20));
        break;
      case 1:
        rpy[random_.below(3)] = tenths();
        break;
      case 2:
        for (double& angle : rpy) angle = 6 * kTwelfth * double(random_.below(4));
        break;
      default:
        break;
    }
    return rpy;
  }

  /// Often that of the joint before, so that angles can be added.
  Vec random_axis() {
    if (!joints_.empty() && random_.below(3) != 0) return joints_.back().axis;
    Vec axis{};
    axis[random_.below(3)] = random_.one_in(2) ? 1 : -1;
    if (random_.one_in(6)) axis[random_.below(3)] += 2;
    return inner(axis, axis) > 0 ? axis : Vec{0, 0, 1};
  }

  void add_joint(std::size_t index, std::optional<RandomFollowing> follows) {
    RandomJoint joint{.name = "j" + std::to_string(index), .slides = random_.one_in(5)};
    joint.rpy = random_rpy();
    for (double& x : joint.xyz) x = random_.one_in(3) ? 0 : tenths();
    if (random_.one_in(4))
      for (double& x : joint.anchor) x = tenths();
    joint.axis = random_axis();
    joint.follows = std::move(follows);
    joints_.push_back(std::move(joint));
  }

  RandomSource random_;
  std::vector<RandomJoint> joints_;
};

}  // namespace regulus::detail::test
