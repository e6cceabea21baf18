// SPDX-License-Identifier: GPL-3.0-or-later
// Series of problems that one number makes harder, and the growth of the boxes with it.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <span>

#include "tests/paper/tables/run_cell.hpp"

namespace regulus::detail::test {

/// The number that grows: the tolerance of the anchors, or the range of the angles in degrees.
enum class Abscissa { kTolerance, kAngle };

struct Series {
  const char* name;
  const char* caption;
  const char* model;
  const char* motion;
  Abscissa abscissa;
  const char* tolerance;  ///< of the anchors, if the angles grow
  const char* tics;       ///< of the picture
  std::span<const double> steps;
};

inline Question question_at(const Series& series, double x) {
  Question question{series.model, series.motion};
  if (series.abscissa == Abscissa::kTolerance) {
    question.tolerances = {fmt::format("base,platform={}", x)};
    return question;
  }
  question.tolerances = {fmt::format("base,platform={}", series.tolerance)};
  for (const char* angle : {"psi", "theta", "phi"})
    question.ranges.push_back(fmt::format("{}=-{}*deg:{}*deg", angle, x, x));
  return question;
}

namespace growth {

inline constexpr double kTolerances1[] = {0,    0.01, 0.02, 0.03, 0.04, 0.05,  0.06,
                                          0.07, 0.08, 0.09, 0.1,  0.11, 0.115, 0.12};
inline constexpr double kAngles1[] = {5, 10, 15, 20, 25};
inline constexpr double kTolerances2[] = {0, 5, 10, 15, 20, 25, 30, 35, 40, 45, 50};
inline constexpr double kAngles2[] = {10, 15, 20, 25, 30, 35};

}  // namespace growth

inline constexpr Series kGrowth[] = {
    {"robot 1, tolerance", "x, y in ±15, z in [45, 50], angles ±15°; by the anchors' tolerance",
     "models/robot_1.toml", "wide_15", Abscissa::kTolerance, "", "0.01, 0.02, 0.05, 0.1",
     growth::kTolerances1},
    {"robot 1, angles", "x, y in ±15, z in [45, 50], exact geometry; by the range of the angles",
     "models/robot_1.toml", "wide_15", Abscissa::kAngle, "0", "5, 10, 15, 20, 25",
     growth::kAngles1},
    {"robot 1, angles, tolerance 0.05", "the same with anchors ±0.05; by the range of the angles",
     "models/robot_1.toml", "wide_15", Abscissa::kAngle, "0.05", "5, 10, 15, 20, 25",
     growth::kAngles1},
    {"robot 2, tolerance", "angles ±20°; by the anchors' tolerance", "models/robot_2.toml",
     "table5_20", Abscissa::kTolerance, "", "5, 10, 20, 50", growth::kTolerances2},
    {"robot 2, angles", "exact geometry; by the range of the angles", "models/robot_2.toml",
     "table5_20", Abscissa::kAngle, "0", "10, 15, 20, 25, 30, 35", growth::kAngles2},
};

/// The boxes of a row of the table, at the value x.
struct GrowthPoint {
  double x;
  double boxes;
};

/// Returns p of boxes ≈ c·xᵖ by least squares of logarithms; nullopt for fewer than three points.
inline std::optional<double> exponent(std::span<const GrowthPoint> points) {
  const auto n = static_cast<double>(points.size());
  if (points.size() < 3) return std::nullopt;
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const GrowthPoint& p : points) {
    const double u = std::log(p.x), v = std::log(p.boxes);
    x += u, y += v, xx += u * u, xy += u * v;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace regulus::detail::test
