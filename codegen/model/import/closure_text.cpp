// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/import/closed_robot.hpp"
#include "codegen/model/import/serial_text.hpp"

namespace regulus::detail {
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

std::string limits_text(const RangeOfJoint& limits) {
  return fmt::format("[{}, {}]", toml_number(limits.range.lower), toml_number(limits.range.upper));
}

/// Around the start, within the limits.
std::string range_text(const ClosedJoint& joint) {
  constexpr double kRounding = 1e-9;
  const std::string at = start_text(joint.value);
  const double reach = joint.slides ? joint.reach : 5 * std::numbers::pi / 180;
  const std::string written = joint.slides ? fmt::format("{:.3g}", reach) : "5*deg";
  const std::string from = at == "0" ? "" : at + " ";
  std::string lower = fmt::format("\"{}-{}{}\"", from, at == "0" ? "" : " ", written);
  std::string upper =
      at == "0" ? fmt::format("\"{}\"", written) : fmt::format("\"{} + {}\"", at, written);
  if (joint.limits) {
    const JointLimits& limits = joint.limits->range;
    if (limits.lower.approx() > joint.value - reach - kRounding) lower = toml_number(limits.lower);
    if (limits.upper.approx() < joint.value + reach + kRounding) upper = toml_number(limits.upper);
  }
  return fmt::format("[{}, {}]", lower, upper);
}

/// The lines of unknowns with limits; empty without any.
std::string ranges_text(const std::vector<ClosedJoint>& joints) {
  std::string text;
  for (const ClosedJoint& joint : joints)
    if (joint.limits)
      text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", joint.name,
                          limits_text(*joint.limits));
  return text.empty() ? "" : fmt::format("range = {{ {} }} # the limits of the file\n", text);
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
      "unknowns = {{ {} }}\nequations = [\n{}]\nstart = {{ {} }}\nradius = {{ {} }}\n{}\n"
      "[motion.home]\n{}\n[motion.around_home] # a guess: give it the ranges of your robot\n{}",
      units_text(robot.driven, "\n"), units_text(robot.passive, ", "), equations, start, radius,
      ranges_text(robot.passive), home, around);
}

}  // namespace regulus::detail
