// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/uncertain_values.hpp"

#include <cmath>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "runtime/interval/floating_point_scope.hpp"

namespace regulus::detail {
namespace {

/// A point of a ball is taken so far below its surface, in parts of the radius.
constexpr double kBelowSurface = 0x1p-24;

/// The uncertain coordinates of each ball, as indices into the uncertain quantities.
std::vector<std::vector<std::size_t>> members_of_balls(const Request& request) {
  std::vector<std::vector<std::size_t>> members(request.model.balls.size());
  const std::set<std::string> names = uncertain_names(request);
  std::size_t next = 0;
  for (const GeometryParameter& g : request.model.geometry) {
    if (!names.contains(g.name)) continue;
    if (g.ball >= 0) members.at(std::size_t(g.ball)).push_back(next);
    ++next;
  }
  return members;
}

}  // namespace

std::vector<double> within_balls(const PreparedClosure& prepared, std::vector<double> uncertain) {
  if (uncertain.empty()) return uncertain;
  const std::size_t from = prepared.shape.parameters;
  for (const std::vector<std::size_t>& members : members_of_balls(prepared.request)) {
    double distance = 0, radius = 0;
    for (const std::size_t i : members) {
      distance = std::hypot(distance, uncertain[i] - mid(prepared.start.place[from + i]));
      radius = rad_ru(prepared.problem.outer[from + i]);
    }
    const double part = (1 - kBelowSurface) * radius / distance;
    if (!(part < 1)) continue;
    for (const std::size_t i : members) {
      const double middle = mid(prepared.start.place[from + i]);
      uncertain[i] = middle + part * (uncertain[i] - middle);
    }
  }
  return uncertain;
}

bool are_possible(const PreparedClosure& prepared, const std::vector<double>& uncertain) {
  const std::size_t from = prepared.shape.parameters;
  for (std::size_t i = 0; i < uncertain.size(); ++i) {
    const std::optional<Interval>& range = prepared.problem.inner[from + i];
    if (!range || !certain_subset(Interval(uncertain[i]), *range)) return false;
  }
  const auto members = members_of_balls(prepared.request);
  for (std::size_t ball = 0; !uncertain.empty() && ball < members.size(); ++ball) {
    const GiNaC::ex& radius = prepared.request.model.balls[ball].radius;
    Interval squares(0.0);
    for (const std::size_t i : members[ball])
      squares += sqr(Interval(uncertain[i]) - prepared.start.place[from + i]);
    if (!members[ball].empty() && !(squares.hi <= sqr(enclose_constant(radius, "a radius")).lo))
      return false;
  }
  return true;
}

bool is_in_motion(const PreparedClosure& prepared, SystemBoxes& system,
                  const std::vector<Interval>& point) {
  std::vector<double> uncertain;
  for (std::size_t k = prepared.shape.parameters; k < prepared.shape.variables; ++k) {
    if (!is_thin(point[k])) return false;
    uncertain.push_back(point[k].lo);
  }
  if (!are_possible(prepared, uncertain)) return false;
  if (prepared.request.motion.constraints.empty() && prepared.request.motion.reach.empty())
    return true;
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  return system.is_certain(point);
}

void aim_at_balls(const PreparedClosure& prepared, const std::vector<double>& along, bool is_with,
                  std::vector<double>& corner) {
  const std::size_t from = prepared.shape.parameters;
  for (const std::vector<std::size_t>& members : members_of_balls(prepared.request)) {
    double size = 0;
    for (const std::size_t i : members) size = std::hypot(size, along[from + i]);
    for (const std::size_t i : members) {
      const double part = size > 0 ? along[from + i] / size : 0;
      corner[i] = mid(prepared.start.place[from + i]) +
                  (is_with ? part : -part) * rad_ru(prepared.problem.outer[from + i]);
    }
  }
}

}  // namespace regulus::detail
