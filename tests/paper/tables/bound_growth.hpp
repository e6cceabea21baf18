// SPDX-License-Identifier: GPL-3.0-or-later
// The growth of the boxes of a bracket with the narrowness that is asked for.
#pragma once

#include <cstdint>
#include <ctime>
#include <fstream>
#include <iterator>
#include <string>

#include "codegen/question/bound/bound_run.hpp"

namespace regulus::detail::test {

/// The forces in the legs of robot 1 under forces of at most 1 N on its platform.
struct BoundSeries {
  const char* motion;
  const char* caption;
};

inline constexpr BoundSeries kBoundSeries[] = {
    {"table4_5", "x, y in ±5, z in [45, 50], angles ±5°"},
    {"wide_15", "x, y in ±15, z in [45, 50], angles ±15°"},
};

inline constexpr double kGaps[] = {0.2, 0.1, 0.05, 0.02, 0.01, 0.005};

/// The result for one gap.
struct BoundCell {
  bool is_closed = false;
  double attained = 0, proved = 0;  ///< newtons; 0: there is none
  std::uint64_t boxes = 0;
  double seconds = 0;  ///< processor time, with that of forming the matrices
};

/// Bounds the forces in all legs, for at most `limit` seconds.
inline BoundCell bound_forces(const BoundSeries& series, double gap, double limit) {
  ModelOptions model;
  model.path = REGULUS_SOURCE_DIR "/models/robot_1.toml";
  model.motion = series.motion;
  std::ifstream file(model.path);
  model.text = std::string(std::istreambuf_iterator<char>(file), {}) +
               "\n[load.one]\nforce = [[-1, 1], [-1, 1], [-1, 1]]\n";
  const Request request = read_request(model);
  BoundSettings settings;
  settings.gap = gap;
  settings.search.threads = 1;
  settings.search.time_limit = limit;
  settings.output.quiet = true;
  const std::clock_t start = std::clock();
  const Bound bound =
      bound_quantity(request, quantity_of(request.model, {.quantity = "force", .load = "one"}),
                     settings, [](const ComponentBound&) {});
  BoundCell cell;
  cell.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  cell.is_closed = bound.is_closed();
  if (const auto* c = bound.decisive_attained()) cell.attained = c->attained->approx;
  if (const auto* c = bound.decisive_proved()) cell.proved = c->proved->approx;
  for (const ComponentBound& c : bound.components) cell.boxes += c.boxes;
  return cell;
}

}  // namespace regulus::detail::test
