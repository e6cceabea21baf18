// SPDX-License-Identifier: GPL-3.0-or-later
// Random robots with loops, written as URDF, MJCF and SDF files; and their kinematics, from the same
// description and with none of the code under test.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "codegen/model/import/import.hpp"
#include "tests/support/loops/file_robot.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail::test {

/// One or two loops, in a coordinate plane or in space, of joints that turn or slide, balls and
/// universal joints, some of which follow a motor. Loops are closed in every way that a file has.
class RandomLoops {
 public:
  explicit RandomLoops(std::uint64_t seed) : random_(seed), format_(Format(random_.below(3))) {
    if (random_.one_in(2)) normal_ = random_.below(3);
    count_ = 1 + random_.below(2);
    for (loop_ = 0; loop_ < count_; ++loop_) add_loop();
    robot_.order();
    text_ = format_ == Format::kUrdf ? urdf() : format_ == Format::kMjcf ? mjcf() : sdf();
    options_.actuated = robot_.motors;
    options_.closure = true;
  }

  [[nodiscard]] const FileRobot& robot() const { return robot_; }
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] const ImportOptions& options() const { return options_; }
  /// How many freedoms there are that neither motors nor loops determine: rods between two balls spin.
  [[nodiscard]] std::size_t idle() const { return idle_; }
  [[nodiscard]] bool is_planar() const { return normal_ < 3; }
  [[nodiscard]] std::string describe() const {
    std::string all = text_;
    for (const std::string& cut : options_.cuts) all += "--cut " + cut + " ";
    for (const std::string& weld : options_.welds) all += "--weld " + weld + " ";
    for (const std::string& motor : options_.actuated) all += "--actuated " + motor + " ";
    return all + "\n" + options_.list;
  }

 private:
  enum class Format { kUrdf, kMjcf, kSdf };
  static constexpr double kTwelfth = 0.26179938779914943654;

  static std::string number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.15g", value);
    return text;
  }
  static std::string words(const Vec& v) {
    return number(v[0]) + " " + number(v[1]) + " " + number(v[2]);
  }
  static double rounded(double x) { return std::round(1000 * x) / 1000; }
  static Vec rounded(const Vec& v) { return {rounded(v[0]), rounded(v[1]), rounded(v[2])}; }
  static Vec rpy_of(const Mat& R) {
    return {std::atan2(R[2][1], R[2][2]), std::atan2(-R[2][0], std::hypot(R[0][0], R[1][0])),
            std::atan2(R[1][0], R[0][0])};
  }

  double hundredths() { return (double(random_.below(81)) - 40) / 100; }
  Vec along_normal() const {
    Vec n{};
    n[normal_] = 1;
    return n;
  }

  Vec place() {
    const Vec p = {hundredths(), hundredths(), hundredths()};
    return p;
  }

  /// In a plane about its normal; in space one angle, or a turn of the cube.
  Vec turns() {
    Vec rpy{};
    const std::size_t kind = random_.below(3);
    if (kind == 0) return rpy;
    if (is_planar()) {
      rpy[normal_] = kind == 1 ? hundredths() : kTwelfth * double(random_.below(24));
    } else if (kind == 1) {
      rpy[random_.below(3)] = hundredths();
    } else {
      for (double& angle : rpy) angle = 6 * kTwelfth * double(random_.below(4));
    }
    return rpy;
  }

  Vec direction(Moves moves) {
    if (is_planar()) {
      if (moves == Moves::kTurns) return (random_.one_in(2) ? 1.0 : -1.0) * along_normal();
      Vec v{};
      v[(normal_ + 1) % 3] = random_.one_in(2) ? 3 : 1;
      v[(normal_ + 2) % 3] = random_.one_in(2) ? 0 : 4;
      return v;
    }
    Vec v{};
    v[random_.below(3)] = random_.one_in(2) ? 1 : -1;
    if (random_.one_in(3)) v[random_.below(3)] += 1;
    return norm(v) > 0 ? v : Vec{0, 0, 1};
  }

  FileJoint& add_joint(const std::string& parent, Moves moves) {
    const std::string n = std::to_string(robot_.joints.size());
    const Vec rpy = turns();
    FileJoint joint{"j" + n,          parent, "l" + n, moves, {of_rpy(rpy), place()},
                    direction(moves), {},     {}};
    if (format_ != Format::kUrdf && random_.one_in(3)) joint.anchor = place();
    robot_.joints.push_back(joint);
    rpy_[joint.name] = rpy;
    return robot_.joints.back();
  }

  /// A link that the file has, among those of the first joints.
  std::string random_link(std::size_t joints) {
    while (true)
      if (const FileJoint& joint = robot_.joints[random_.below(joints)]; !is_closing(joint))
        return joint.child;
  }

  /// A loop that begins at a link and ends at another.
  void add_loop() {
    const bool on_first = loop_ > 0;
    const std::size_t before = robot_.joints.size();
    std::string from = "base", to = "base";
    if (on_first) {
      from = random_link(before);
      if (random_.one_in(2)) to = random_link(before);
      while (from == to) to = "base";
    }
    // A spherical joint at the end, or frames that are one, with joints between them.
    const bool holds_frames = random_.below(3) != 0;
    const std::size_t rank = is_planar() ? (holds_frames ? 3 : 2) : (holds_frames ? 6 : 3);
    const std::size_t drives = on_first ? random_.below(2) : 1 + random_.below(2);
    std::size_t left = rank + drives;
    const Moves closing = closing_joint(holds_frames);
    if (closing != Moves::kNot) left -= 1;
    // A ball that two loops pass is refused.
    bool has_ball = (!holds_frames && !is_planar()) || loop_ + 1 < count_;
    bool has_slide = false;
    std::string end = from;
    std::vector<std::string> scalars;
    while (left > 0) {
      Moves moves = Moves::kTurns;
      if (!has_slide && random_.one_in(5)) moves = Moves::kSlides, has_slide = true;
      if (!is_planar() && left >= 3 + drives && random_.one_in(3) &&
          (!has_ball || (count_ == 1 && !holds_frames && idle_ == 0))) {
        if (has_ball && left < 4 + drives - 1) continue;
        moves = Moves::kAsABall;
        if (has_ball) ++idle_, ++left;  // a rod: it spins
        has_ball = true;
      }
      const FileJoint& joint = add_joint(end, moves);
      end = joint.child;
      left -= moves == Moves::kAsABall ? 3 : 1;
      if (moves != Moves::kAsABall) scalars.push_back(joint.name);
    }
    std::string motor;
    for (std::size_t k = 0; k < drives && !scalars.empty(); ++k) {
      const std::size_t at = random_.below(scalars.size());
      motor = scalars[at];
      robot_.motors.push_back(motor);
      scalars.erase(scalars.begin() + std::ptrdiff_t(at));
    }
    if (!motor.empty() && random_.one_in(3)) end = add_follower(end, motor);
    close(end, to, holds_frames, closing);
  }

  /// Returns the link behind a joint that follows the motor.
  std::string add_follower(const std::string& end, const std::string& motor) {
    FileJoint& follower = add_joint(end, Moves::kTurns);
    const double multipliers[] = {1, -1, 0.5, 2};
    follower.rule = {motor, multipliers[random_.below(4)], random_.one_in(2) ? 0 : 0.3};
    return follower.child;
  }

  /// The joint that a URDF constraint or an SDF file has where the loop is closed.
  Moves closing_joint(bool holds_frames) {
    if (!holds_frames || format_ == Format::kMjcf || !random_.one_in(2)) return Moves::kNot;
    return random_.one_in(3) ? Moves::kSlides : Moves::kTurns;
  }

  void close(const std::string& end, const std::string& to, bool holds_frames, Moves closing) {
    const std::string n = std::to_string(loop_);
    Vec rpy = turns(), xyz = place();
    const Frame at_first = {of_rpy(rpy), xyz};
    FileRobot so_far = robot_;
    if (format_ != Format::kUrdf)
      for (FileJoint& joint : so_far.joints)
        if (joint.rule) joint.rule->offset = 0;  // the file's zero
    so_far.loops.clear();
    so_far.order();
    const Configuration zero = so_far.at_zero();
    const Frame there =
        inverted(so_far.frame_of(to, zero)) * (so_far.frame_of(end, zero) * at_first);
    FileLoop loop{end, to, at_first, there, holds_frames};
    const Vec axis = closing == Moves::kNot ? Vec{0, 0, 1} : direction(closing);
    const bool has_joint = closing != Moves::kNot;
    if (has_joint) {
      // The joint begins where the loop is closed.
      robot_.joints.push_back({"c" + n, end, "c" + n + "_moved", closing, at_first, axis, {}, {}});
      rpy_["c" + n] = rpy;
      loop.first = "c" + n + "_moved";
      loop.at_first = {};
    }
    if (format_ == Format::kUrdf) {
      Vec back = is_planar() ? Vec{} : rounded(rpy_of(there.R));
      if (is_planar()) back[normal_] = rounded(inner(turn_of(there.R), along_normal()));
      loop.at_second = {of_rpy(back), rounded(there.p)};
      close_urdf(n, end, to, {xyz, rpy}, {rounded(there.p), back}, holds_frames, closing, axis);
    } else if (format_ == Format::kMjcf) {
      close_mjcf(end, to, xyz, loop);
    } else {
      close_sdf(n, end, to, {xyz, rpy}, loop, closing, axis);
    }
    robot_.loops.push_back(loop);
  }

  struct Written {
    Vec xyz{}, rpy{};
  };

  void close_urdf(const std::string& n, const std::string& end, const std::string& to,
                  const Written& first, const Written& second, bool holds_frames, Moves closing,
                  const Vec& axis) {
    const bool as_constraint = closing != Moves::kNot || random_.one_in(3);
    if (as_constraint) {
      const std::string type = !holds_frames               ? "spherical"
                               : closing == Moves::kNot    ? "fixed"
                               : closing == Moves::kSlides ? "prismatic"
                               : random_.one_in(2)         ? "revolute"
                                                           : "continuous";
      loops_ += "<constraint name=\"c" + n + "\" type=\"" + type + "\"><parent link=\"" + end +
                "\"/><parent_origin xyz=\"" + words(first.xyz) + "\" rpy=\"" + words(first.rpy) +
                "\"/><parent_axis xyz=\"" + words(axis) + "\"/><child link=\"" + to +
                "\"/><child_origin xyz=\"" + words(second.xyz) + "\" rpy=\"" + words(second.rpy) +
                "\"/></constraint>\n";
      return;
    }
    for (const auto& [link, name, at] :
         {std::tuple(end, "tip" + n, first), std::tuple(to, "pin" + n, second)})
      loops_ += "<link name=\"" + name + "\"/><joint name=\"" + name +
                "_at\" type=\"fixed\"><parent link=\"" + link + "\"/><child link=\"" + name +
                "\"/><origin xyz=\"" + words(at.xyz) + "\" rpy=\"" + words(at.rpy) +
                "\"/></joint>\n";
    if (!options_.list.empty() || (loop_ == 0 && random_.one_in(3))) {
      listed_.emplace_back("[tip" + n + ", pin" + n + "]", holds_frames ? "6d" : "3d");
      std::string pairs, types;
      for (const auto& [pair, type] : listed_) {
        pairs += (pairs.empty() ? "" : ", ") + pair;
        types += (types.empty() ? "" : ", ") + type;
      }
      options_.list = "closed_loop: [" + pairs + "]\ntype: [" + types + "]\n";
      options_.list_file = "loops.yaml";
    } else {
      (holds_frames ? options_.welds : options_.cuts).push_back("tip" + n + "=pin" + n);
    }
  }

  void close_mjcf(const std::string& end, const std::string& to, const Vec& xyz, FileLoop& loop) {
    const auto body = [](const std::string& link) { return link == "base" ? "world" : link; };
    if (!loop.holds_frames) {
      loops_ += "<connect body1=\"" + end + "\" body2=\"" + body(to) + "\" anchor=\"" + words(xyz) +
                "\"/>\n";
      return;
    }
    std::string relative;
    if (random_.one_in(2)) {
      // Where the second body is in the first, a little off.
      const Frame there = inverted(loop.at_second * inverted(loop.at_first));
      const Vec v = turn_of(there.R);
      const double half = norm(v) / 2;
      const double f = half > 1e-9 ? std::sin(half) / (2 * half) : 0.5;
      const double w = rounded(std::cos(half));
      const Vec q = rounded(f * v), p = rounded(there.p);
      relative = "\" relpose=\"" + words(p) + " " + number(w) + " " + words(q);
      const double angle = 2 * std::atan2(norm(q), w);
      loop.at_first = {norm(q) > 0 ? turn_about(q, angle) : Frame{}.R, p};
      loop.at_second = {};
    }
    loops_ += "<weld body1=\"" + end + "\" body2=\"" + body(to) + relative + "\"/>\n";
  }

  void close_sdf(const std::string& n, const std::string& end, const std::string& to,
                 const Written& first, FileLoop& loop, Moves closing, const Vec& axis) {
    const std::string type = !loop.holds_frames          ? "ball"
                             : closing == Moves::kNot    ? "fixed"
                             : closing == Moves::kSlides ? "prismatic"
                             : random_.one_in(2)         ? "revolute"
                                                         : "continuous";
    loops_ += "<joint name=\"c" + n + "\" type=\"" + type + "\"><pose relative_to=\"" + end +
              "\">" + words(first.xyz) + " " + words(first.rpy) + "</pose><parent>" + end +
              "</parent><child>" + to + "</child>";
    if (closing != Moves::kNot) loops_ += "<axis><xyz>" + words(axis) + "</xyz></axis>";
    loops_ += "</joint>\n";
  }

  [[nodiscard]] bool is_closing(const FileJoint& joint) const {
    return joint.child.ends_with("_moved");
  }

  [[nodiscard]] std::string urdf() const {
    std::string text = "<robot name=\"loops\">\n<link name=\"base\"/>\n";
    for (const FileJoint& joint : robot_.joints) {
      if (is_closing(joint)) continue;
      const char* type = joint.moves == Moves::kAsABall  ? "spherical"
                         : joint.moves == Moves::kSlides ? "prismatic"
                                                         : "continuous";
      text += "<link name=\"" + joint.child + "\"/><joint name=\"" + joint.name + "\" type=\"" +
              type + "\"><parent link=\"" + joint.parent + "\"/><child link=\"" + joint.child +
              "\"/><origin xyz=\"" + words(joint.origin.p) + "\" rpy=\"" +
              words(rpy_.at(joint.name)) + "\"/><axis xyz=\"" + words(joint.axis) + "\"/>";
      if (joint.rule)
        text += "<mimic joint=\"" + joint.rule->leader + "\" multiplier=\"" +
                number(joint.rule->multiplier) + "\" offset=\"" + number(joint.rule->offset) +
                "\"/>";
      text += "</joint>\n";
    }
    return text + loops_ + "</robot>\n";
  }

  [[nodiscard]] std::string bodies(const std::string& link) const {
    std::string text;
    for (const FileJoint& joint : robot_.joints) {
      if (joint.parent != link) continue;
      const char* type = joint.moves == Moves::kAsABall  ? "ball"
                         : joint.moves == Moves::kSlides ? "slide"
                                                         : "hinge";
      text += "<body name=\"" + joint.child + "\" pos=\"" + words(joint.origin.p) + "\" euler=\"" +
              words(rpy_.at(joint.name)) + "\"><joint name=\"" + joint.name + "\" type=\"" + type +
              "\" pos=\"" + words(joint.anchor) + "\" axis=\"" + words(joint.axis) + "\"/>\n" +
              bodies(joint.child) + "</body>";
    }
    return text;
  }

  [[nodiscard]] std::string mjcf() const {
    std::string rules;
    for (const FileJoint& joint : robot_.joints)
      if (joint.rule)
        rules += "<joint joint1=\"" + joint.name + "\" joint2=\"" + joint.rule->leader +
                 "\" polycoef=\"" + number(joint.rule->offset) + " " +
                 number(joint.rule->multiplier) + " 0 0 0\"/>\n";
    return "<mujoco model=\"loops\"><compiler angle=\"radian\" eulerseq=\"XYZ\"/>\n<worldbody>\n" +
           bodies("base") + "</worldbody>\n<equality>\n" + rules + loops_ +
           "</equality></mujoco>\n";
  }

  [[nodiscard]] std::string sdf() const {
    std::string text = "<sdf version=\"1.11\"><model name=\"loops\">\n<link name=\"base\"/>\n";
    for (const FileJoint& joint : robot_.joints) {
      if (is_closing(joint)) continue;
      const char* type = joint.moves == Moves::kAsABall  ? "ball"
                         : joint.moves == Moves::kSlides ? "prismatic"
                                                         : "revolute";
      text += "<link name=\"" + joint.child + "\"><pose relative_to=\"" + joint.parent + "\">" +
              words(joint.origin.p) + " " + words(rpy_.at(joint.name)) +
              "</pose></link>\n<joint name=\"" + joint.name + "\" type=\"" + type + "\"><pose>" +
              words(joint.anchor) + " 0 0 0</pose><parent>" + joint.parent + "</parent><child>" +
              joint.child + "</child>";
      if (joint.moves != Moves::kAsABall) {
        text += "<axis><xyz>" + words(joint.axis) + "</xyz>";
        if (joint.rule)
          text += "<mimic joint=\"" + joint.rule->leader + "\"><multiplier>" +
                  number(joint.rule->multiplier) + "</multiplier><offset>" +
                  number(joint.rule->offset) + "</offset></mimic>";
        text += "</axis>";
      }
      text += "</joint>\n";
    }
    return text + loops_ + "</model></sdf>\n";
  }

  RandomSource random_;
  const Format format_;
  std::size_t normal_ = 3;  ///< of the plane; 3 in space
  std::size_t count_ = 1, loop_ = 0, idle_ = 0;
  FileRobot robot_;
  std::map<std::string, Vec> rpy_;  ///< by joint
  std::vector<std::pair<std::string, std::string>> listed_;
  std::string loops_, text_;
  ImportOptions options_;
};

}  // namespace regulus::detail::test
