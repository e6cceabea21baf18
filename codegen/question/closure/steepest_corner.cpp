// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/steepest_corner.hpp"

#include "runtime/interval/floating_point_scope.hpp"

namespace regulus::detail {
namespace {

constexpr int kMostCorners = 8;

/// The slope of log |det Φ_p| along the branch by each variable: the trace of Φ_p⁻¹ dΦ_p.
std::vector<double> slopes_of_determinant(const SystemBoxes::System& system,
                                          const TrackedPoint& point, const ClosedShape& shape) {
  const std::size_t n = shape.unknowns, m = shape.variables;
  std::vector<double> alone(m + n, 0.0);
  for (std::size_t by = 0; by < m + n; ++by)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        alone[by] += point.inverse[i * n + j] * mid(system.rates_by_unknown[(by * n + j) * n + i]);
  std::vector<double> slopes(alone.begin(), alone.begin() + std::ptrdiff_t(m));
  for (std::size_t k = 0; k < m; ++k)
    for (std::size_t l = 0; l < n; ++l) slopes[k] += alone[m + l] * point.slopes[l * m + k];
  return slopes;
}

}  // namespace

std::optional<std::vector<double>> steepest_corner(const PreparedClosure& prepared) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  SystemBoxes system(prepared.problem, prepared.scaling, prepared.shape);
  std::vector<double> corner = prepared.near_start.variables;
  for (int step = 0; step < kMostCorners; ++step) {
    const auto way = track_until_lost(system, prepared.shape, prepared.near_start, corner);
    if (!way) return std::nullopt;
    if (way->part < 1) return corner;
    SystemBoxes::Box at;
    for (const double x : way->last.at.variables) at.emplace_back(x);
    for (const double p : way->last.at.unknowns) at.emplace_back(p);
    system.evaluate({&at, 1}, true);
    const auto over = system.at(0);
    if (!over) return std::nullopt;
    const std::vector<double> slopes = slopes_of_determinant(*over, way->last, prepared.shape);
    std::vector<double> next = corner;
    for (std::size_t k = 0; k < next.size(); ++k) {
      const std::optional<Interval>& range = prepared.problem.inner[k];
      if (range && slopes[k] != 0) next[k] = slopes[k] > 0 ? range->lo : range->hi;
    }
    if (next == corner) return std::nullopt;
    corner = std::move(next);
  }
  return std::nullopt;
}

}  // namespace regulus::detail
