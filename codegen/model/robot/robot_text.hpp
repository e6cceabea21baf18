// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "codegen/model/robot/robot.hpp"

namespace regulus::detail {

/// The model file of a robot, and the place in C++ that each of its lines comes from.
class RobotText {
 public:
  explicit RobotText(const Robot& robot);

  [[nodiscard]] const std::string& text() const noexcept { return text_; }
  /// Lines are counted from 1; 0 is the robot as a whole.
  [[nodiscard]] SourcePlace place_of(int line) const;

 private:
  void line(const std::string& text, const SourcePlace& place);
  void table(const std::string& name, const SourcePlace& place);
  void section(const WrittenSection& section);
  void named_section(const std::string& name, const WrittenSection& section);
  void motion(const RobotMotion& motion);
  void dotted(const std::string& key, const WrittenSection& section);

  std::string text_;
  std::vector<SourcePlace> places_;
  SourcePlace robot_;
};

}  // namespace regulus::detail
