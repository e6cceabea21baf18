// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cmath>

#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/import/closed_robot.hpp"

namespace regulus {
namespace {

std::string units_text(const std::vector<ClosedJoint>& joints, const char* separator) {
  std::string text;
  for (const ClosedJoint& joint : joints)
    text += fmt::format("{}{} = \"{}\"", text.empty() ? "" : separator, joint.name,
                        joint.slides ? "m" : "rad");
  return text;
}

std::string start_text(double value) {
  return fmt::format("{:.15g}", std::fabs(value) < 1e-14 ? 0.0 : value);
}

std::string range_text(const ClosedJoint& joint) {
  const std::string at = start_text(joint.value);
  if (joint.slides) return fmt::format("[\"{0} - {1:.3g}\", \"{0} + {1:.3g}\"]", at, joint.reach);
  if (at == "0") return "[\"-5*deg\", \"5*deg\"]";
  return fmt::format("[\"{0} - 5*deg\", \"{0} + 5*deg\"]", at);
}

}  // namespace

std::string closure_text(const ClosedRobot& robot) {
  // The start is a solution but for rounding, and others may be near.
  constexpr const char* kRadius = "1e-5";
  std::string equations, start, radius, home, around;
  for (const GiNaC::ex& equation : robot.equations)
    equations += fmt::format("  \"{}\",\n", formula_text(equation));
  for (const auto* joints : {&robot.driven, &robot.passive})
    for (const ClosedJoint& joint : *joints)
      start +=
          fmt::format("{}{} = {}", start.empty() ? "" : ", ", joint.name, start_text(joint.value));
  for (const ClosedJoint& joint : robot.passive)
    radius += fmt::format("{}{} = {}", radius.empty() ? "" : ", ", joint.name, kRadius);
  for (const ClosedJoint& joint : robot.driven) {
    home += fmt::format("{} = {}\n", joint.name, start_text(joint.value));
    around += fmt::format("{} = {}\n", joint.name, range_text(joint));
  }
  return fmt::format(
      "[pose] # the driven joints\n{}\n\n"
      "[closure] # the passive joints, and what closes the loops\n"
      "unknowns = {{ {} }}\nequations = [\n{}]\nstart = {{ {} }}\nradius = {{ {} }}\n\n"
      "[motion.home]\n{}\n[motion.around_home] # a guess: give it the ranges of your robot\n{}",
      units_text(robot.driven, "\n"), units_text(robot.passive, ", "), equations, start, radius,
      home, around);
}

}  // namespace regulus
