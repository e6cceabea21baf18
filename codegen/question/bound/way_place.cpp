// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/way_place.hpp"

#include <fmt/format.h>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/report.hpp"
#include "codegen/question/way/trajectory_report.hpp"

namespace regulus::detail {
namespace {

/// "x = 9.5 cm, y = -2 cm": rounded, of all pose parameters but `parameter`.
std::string pose_text(const PreparedSearch& p, const WitnessPoint& point,
                      const std::string& parameter) {
  std::string text;
  for (std::size_t i = 0; i < point.pose.size() && i < p.labels.pose.size(); ++i)
    if (p.labels.pose[i].name != parameter)
      text += fmt::format("{}{} = {}{}", text.empty() ? "" : ", ", p.labels.pose[i].name,
                          short_interval(point.pose[i]), unit_suffix(p.labels.pose[i].unit));
  return text;
}

}  // namespace

AttainedPlace place_on_way(const Trajectory& trajectory, std::size_t piece,
                           const PreparedSearch& prepared, const Result& result,
                           const std::string& parameter, bool has_values) {
  AttainedPlace place = attained_place(prepared, result, parameter);
  if (!has_values) place.values.clear();
  std::optional<Interval> s;
  if (result.witness) {
    const Witness& witness = *result.witness;
    const WitnessPoint& point = witness.near ? *witness.near : witness.points.front();
    s = point.variables.front();
    place.values =
        fmt::format("           {}\n", pose_text(prepared, point, parameter)) + place.values;
  }
  place.pose = describe_segment(trajectory, piece, s);
  place.json["segment"] = json_segment(trajectory, piece, s);
  return place;
}

}  // namespace regulus::detail
