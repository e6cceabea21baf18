// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/way/trajectory.hpp"

#include <algorithm>
#include <filesystem>

#include "codegen/model/names.hpp"
#include "codegen/model/way/gcode_file.hpp"
#include "codegen/model/way/waypoint_file.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {

using GiNaC::ex;

const ex& coefficient(const PieceOfPose& piece, std::size_t index) {
  if (index < piece.power.size()) return piece.power[index];
  return index == 4 ? piece.cosine : index == 5 ? piece.sine : piece.turn;
}

ex expression_of(const PieceOfPose& piece, const ex& s) {
  ex result = 0;
  for (std::size_t i = 0; i < piece.power.size(); ++i)
    result += piece.power[i] * GiNaC::pow(s, static_cast<int>(i));
  if (!piece.cosine.is_zero()) result += piece.cosine * GiNaC::cos(piece.turn * s);
  if (!piece.sine.is_zero()) result += piece.sine * GiNaC::sin(piece.turn * s);
  return result;
}

std::string file_of_waypoints(const Model& model, const Motion& motion) {
  const std::filesystem::path path(motion.waypoints->file);
  return path.is_absolute() ? path.string()
                            : (std::filesystem::path(model.path).parent_path() / path).string();
}

void load_trajectory(const Model& model, Motion& motion) {
  if (!motion.waypoints || motion.trajectory) return;
  const std::string file = file_of_waypoints(model, motion);
  auto trajectory = std::make_shared<Trajectory>(
      is_gcode_file(file) ? read_gcode(model, motion, file) : read_waypoints(model, motion, file));
  motion.trajectory = std::move(trajectory);
}

/// Throws    UsageError for a constraint with a parameter that is not one of the pose.
static void require_constraints_of_pose(const Model& model, const Motion& motion) {
  for (const MotionParameter& p : motion.parameters) {
    const bool is_pose =
        std::ranges::find(model.pose, p.name, &PoseParameter::name) != model.pose.end();
    const auto names_it = [&p](const ex& constraint) { return constraint.has(p.symbol); };
    if (!is_pose && std::ranges::any_of(motion.constraints, names_it))
      throw UsageError("--waypoints: the motion " + in_quotes(motion.name) +
                       " has a constraint with its parameter " + in_quotes(p.name) +
                       ", which way-points do not have; name another motion");
  }
}

void follow_waypoints(const Model& model, Motion& motion, const std::string& file) {
  require_constraints_of_pose(model, motion);
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(file, error);
  WaypointSource source;
  if (motion.waypoints) source = *motion.waypoints;
  source.file = error ? file : absolute.string();
  source.shown = file;
  motion.waypoints = std::move(source);
  motion.trajectory = nullptr;
  motion.parameters.clear();
  load_trajectory(model, motion);
}

}  // namespace regulus::detail
