// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/trajectory_request.hpp"

#include "codegen/model/exact/decimal.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {

Request hull_request(const Request& request, const PathBounds& path) {
  Request hull = request;
  Motion& motion = hull.motion;
  motion.waypoints.reset();
  motion.trajectory = nullptr;
  motion.parameters.clear();
  const std::vector<MotionParameter>& added = request.motion.parameters;
  motion.error.assign(hull.model.pose.size(), 0);
  const std::vector<PieceOfPose>& first = request.motion.trajectory->pieces.front().pose;
  for (std::size_t i = 0; i < first.size(); ++i) motion.pose[i] = first[i].power[0];
  for (std::size_t m = 0; m < path.moving().size(); ++m) {
    const PoseParameter& p = hull.model.pose[path.moving()[m]];
    const Interval range = path.over_pieces(0, path.pieces(), m) + path.errors()[m];
    if (!is_bounded(range))
      throw InputError::statement(request.motion.trajectory->file, 0,
                                  "the numbers of " + p.name + " are too large",
                                  "write numbers within the range of doubles");
    motion.parameters.push_back(
        {p.symbol, p.name, p.unit, {exact_value(range.lo), exact_value(range.hi)}});
    motion.pose[path.moving()[m]] = p.symbol;
  }
  motion.parameters.insert(motion.parameters.end(), added.begin(), added.end());
  return hull;
}

}  // namespace regulus::detail
