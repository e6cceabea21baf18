// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/written_legs.hpp"

#include <utility>

#include "runtime/formal/coq_question.hpp"
#include "runtime/formal/coq_real.hpp"
#include "runtime/formal/named_legs.hpp"

namespace regulus::verifier {
namespace {

std::string word_of_matrix(bool is_planar, bool is_point, bool has_rates) {
  if (is_point)
    return std::string(has_rates ? "rates_" : "") + "of_point" + (is_planar ? "_in_plane" : "");
  return std::string(has_rates ? "rates_" : "") + (is_planar ? "in_plane" : "in_space");
}

std::string list_of_legs(const RobotOfModel& robot, const std::string& margin) {
  std::vector<CoqItem> items;
  for (const CoqLeg& leg : robot.chains) items.push_back({"", leg.text});
  return coq_list(items, margin);
}

std::string matrix_of(const RobotOfModel& robot, bool has_rates, const std::string& orientation) {
  const bool is_planar = robot.chains.front().values.is_planar;
  const bool is_point = robot.orientation == "point";
  const std::vector<std::string> position(robot.pose.begin(),
                                          robot.pose.begin() + (is_planar ? 2 : 3));
  std::string text = '(' + word_of_matrix(is_planar, is_point, has_rates);
  text += robot.is_geometry_certain ? " legs" : "\n    " + list_of_legs(robot, "     ") + "\n   ";
  text += " (" + text_of(position, ", ") + ')';
  if (is_point) return text + ')';
  return text + ' ' + (is_planar ? coq_argument(robot.pose.back()) : orientation) + ')';
}

std::string definition_of(const RobotOfModel& robot) {
  if (!robot.is_geometry_certain) return "";
  return "(** The legs of the model file: the joints on the base and on the platform, directions "
         "of "
         "axes\n    and rails, lengths of cranks and rods, working modes. *)\nDefinition legs : "
         "list robot_leg :=\n  " +
         list_of_legs(robot, "   ") + ".\n\n";
}

}  // namespace

WrittenMatrix write_legs(const Question& question, const WrittenValues& values, RobotOfModel& robot,
                         const std::string& orientation) {
  const auto unit = values.find("legs.angle_unit");
  const bool in_degrees = unit != values.end() && unit->second.text == "deg";
  NamedMatrix named = name_legs(robot, in_degrees, question.has_threshold, question.singular);
  std::string naming = "  open_legs.\n";
  for (std::size_t i = 0; i < robot.chains.size(); ++i)
    naming += "  name_leg as _" + std::to_string(i + 1) + ".\n";
  return {std::move(named), "Legs", definition_of(robot),
          matrix_of(robot, question.has_threshold, orientation), naming + "  close_legs.\n"};
}

}  // namespace regulus::verifier
