// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/page/way_json.hpp"

#include <nlohmann/json.hpp>

#include "codegen/kernel/formulation/variety.hpp"

namespace regulus::detail {

nlohmann::ordered_json json_way(const Trajectory& trajectory) {
  using Json = nlohmann::ordered_json;
  const auto approx = [](const auto& time) { return mid(enclose_constant(time, "a time")); };
  Json pieces = Json::array();
  for (const TrajectoryPiece& piece : trajectory.pieces)
    pieces.push_back({{"lines", {piece.first_line, piece.last_line}},
                      {"times", {approx(piece.begin), approx(piece.end)}}});
  return {{"file", trajectory.file},
          {"sha256", trajectory.sha256},
          {"interpolation", trajectory.interpolation},
          {"time_unit", trajectory.has_time ? Json(trajectory.time_unit) : Json(nullptr)},
          {"pieces", pieces}};
}

}  // namespace regulus::detail
