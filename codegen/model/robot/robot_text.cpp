// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/robot/robot_text.hpp"

#include <algorithm>

namespace regulus::detail {

RobotText::RobotText(const Robot& robot) : robot_(robot.place_) {
  section(robot.header_);
  named_section("pose", robot.pose_);
  named_section("geometry", robot.geometry_);
  named_section("let", robot.let_);
  named_section("matrix", robot.matrix_);
  for (const RobotMotion& of : robot.motions_) motion(of);
}

SourcePlace RobotText::place_of(int line) const {
  if (line < 1 || static_cast<std::size_t>(line) > places_.size()) return robot_;
  return places_[static_cast<std::size_t>(line) - 1];
}

/// `text` may have several lines.
void RobotText::line(const std::string& text, const SourcePlace& place) {
  text_ += text + '\n';
  places_.insert(places_.end(), 1 + static_cast<std::size_t>(std::ranges::count(text, '\n')),
                 place);
}

void RobotText::table(const std::string& name, const SourcePlace& place) {
  line("", place);
  line(std::string("[").append(name) + ']', place);
}

void RobotText::section(const WrittenSection& section) {
  for (const WrittenLine& of : section) line(written_key(of.key) + " = " + of.value, of.place);
}

void RobotText::named_section(const std::string& name, const WrittenSection& lines) {
  if (lines.empty()) return;
  table(name, lines.front().place);
  section(lines);
}

void RobotText::dotted(const std::string& key, const WrittenSection& lines) {
  if (lines.empty()) return;
  // Each entry has a line of its own, unlike in an inline table, so a message has the right place.
  for (const WrittenLine& of : lines)
    line(key + "." + written_key(of.key) + " = " + of.value, of.place);
}

void RobotText::motion(const RobotMotion& motion) {
  table("motion." + written_key(motion.name_), motion.place_);
  dotted("parameters", motion.parameters_);
  section(motion.poses_);
  if (!motion.constraints_.empty())
    line("constraints = " + written(motion.constraints_), motion.constraints_place_);
  dotted("error", motion.errors_);
  section(motion.alpha_);
}

}  // namespace regulus::detail
