// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/listed_solutions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/question/solve/leg_lines.hpp"
#include "codegen/question/solve/platform_legs.hpp"
#include "codegen/question/solve/search_range.hpp"
#include "codegen/question/solve/system_solutions.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

/// Parts of the width of a tube, which the verifier finds in another way.
constexpr double kUsualCondition = 0x1p-10, kWiderWidth = 0.5, kLeastWider = 0x1p-12;

ex width_of(const Closure& closure, std::size_t unknown) {
  return closure.ranges[unknown].hi - closure.ranges[unknown].lo;
}

/// True if the unknown is looked for all around.
bool turns(const Closure& closure, std::size_t unknown) {
  const ex period = period_of(closure, unknown), width = width_of(closure, unknown);
  return !period.is_zero() &&
         !(enclose_constant(width, "a range").hi < enclose_constant(period, "a period").lo);
}

/// Pose parameters have the values of the place. Other parameters become constants.
void fix_parameters(Request& request) {
  Motion& motion = request.motion;
  GiNaC::exmap values;
  for (const MotionParameter& p : motion.parameters)
    if (std::ranges::any_of(request.model.pose,
                            [&](const PoseParameter& q) { return q.symbol.is_equal(p.symbol); }))
      values[p.symbol] = p.range.lo;
    else
      request.model.geometry.push_back({p.symbol, p.name, p.range.lo, 0, "", -1});
  for (ex& x : motion.pose) x = x.subs(values);
  motion.parameters.clear();
}

/// Wider than the enclosures, so that the verifier's doubles can show that one solution is in each.
///
/// Requires  MXCSR at nearest.
std::vector<std::vector<Interval>> widened(const Solutions& solutions, const Listed& listed,
                                           double part) {
  std::vector<std::vector<Interval>> tubes = listed.tubes;
  for (std::size_t k = 0; k < tubes.size(); ++k) {
    const double worse = std::max(1.0, solutions.found[k].condition * kUsualCondition);
    for (std::size_t i = 0; i < tubes[k].size(); ++i) {
      const double step =
          std::max(part * width_ru(tubes[k][i]), kWiderForSearch * worse * listed.sizes[i]);
      tubes[k][i] += Interval(-step, step);
    }
  }
  return tubes;
}

bool are_disjoint(const std::vector<std::vector<Interval>>& tubes) {
  for (std::size_t a = 0; a < tubes.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (std::ranges::equal(tubes[a], tubes[b], [](const Interval& x, const Interval& y) {
            return !certain_disjoint(x, y);
          }))
        return false;
  return true;
}

Interval angle_pi() { return enclose_constant(GiNaC::Pi, "pi"); }

/// The values of an unknown that turns, in radians, within less than a period if they are not all around.
std::vector<Interval> angles_of(const Solutions& solutions, std::size_t unknown) {
  const SolvedUnknown& u = solutions.unknowns[unknown];
  const double turns = std::round(u.period / (u.unit == "deg" ? 360 : 2 * std::numbers::pi));
  const Interval once = Interval(2.0) * angle_pi(),
                 turn = turns == 1 ? once : Interval(turns) * once;
  const Interval unit = turn / Interval(u.period);
  std::vector<Interval> angles;
  std::vector<double> order;
  for (const CertainSolution& solution : solutions.found) {
    const Interval angle = solution.values[unknown] * unit;
    angles.push_back(angle - Interval(std::floor(mid(angle) / mid(turn))) * turn);
    order.push_back(mid(angles.back()));
  }
  std::ranges::sort(order);
  double first = 0, gap = -1;  // the angle after the widest gap
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double before = i == 0 ? order.back() - mid(turn) : order[i - 1];
    if (order[i] - before > gap) gap = order[i] - before, first = order[i];
  }
  for (Interval& angle : angles)
    if (mid(angle) < first) angle += turn;
  return angles;
}

/// Returns x moved by whole periods to be near another number.
double moved_near(double x, double other, double period) {
  return x - std::round((x - other) / period) * period;
}

Listed planar_list(const Request& request, const Solutions& solutions) {
  const std::vector<Interval> angles = angles_of(solutions, 2);
  const double size = size_of(request, solutions), turn = 2 * std::numbers::pi;
  Listed listed{{}, {size, size, 1}};
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const CertainSolution& solution = solutions.found[k];
    listed.tubes.push_back({solution.values[0], solution.values[1], angles[k]});
    if (solution.middle.empty()) continue;
    const double angle = solution.middle[2] * turn / solutions.unknowns[2].period;
    listed.middles.push_back(
        {solution.middle[0], solution.middle[1], moved_near(angle, mid(angles[k]), turn)});
  }
  return listed;
}

Listed posture_list(const Solutions& solutions) {
  const std::size_t joints = solutions.unknowns.size();
  std::vector<std::vector<Interval>> values(joints);
  Listed listed{{}, usual_sizes(solutions)};
  for (std::size_t i = 0; i < joints; ++i) {
    const SolvedUnknown& u = solutions.unknowns[i];
    if (u.period != 0)
      values[i] = angles_of(solutions, i);
    else
      for (const CertainSolution& solution : solutions.found)
        values[i].push_back(u.unit == "deg" ? solution.values[i] * angle_pi() / Interval(180.0)
                                            : solution.values[i]);
    if (u.period != 0 || u.unit == "deg") listed.sizes[i] = 1;  // in radians
  }
  for (std::size_t k = 0; k < solutions.found.size(); ++k) {
    auto& tube = listed.tubes.emplace_back();
    for (const auto& of_joint : values) tube.push_back(of_joint[k]);
    if (solutions.found[k].middle.empty()) continue;
    auto& middle = listed.middles.emplace_back();
    for (std::size_t i = 0; i < joints; ++i) {
      const SolvedUnknown& u = solutions.unknowns[i];
      const double x =
          solutions.found[k].middle[i] * (u.unit == "deg" ? std::numbers::pi / 180 : 1);
      const double period = u.period * (u.unit == "deg" ? std::numbers::pi / 180 : 1);
      middle.push_back(period != 0 ? moved_near(x, mid(tube[i]), period) : x);
    }
  }
  return listed;
}

Listed pose_list(const Request& request, const Solutions& solutions) {
  const double size = size_of(request, solutions);
  Listed listed{{}, {size, size, size, 1, 1, 1, 1}};
  for (const CertainSolution& solution : solutions.found) {
    listed.tubes.push_back(solution.values);
    if (!solution.middle.empty()) listed.middles.push_back(solution.middle);
  }
  return listed;
}

Listed configuration_list(const Request& request, const Solutions& solutions) {
  const Request searched = searched_request(request);
  const Closure& closure = *searched.model.closure;
  std::vector<Interval> periods;  // 0: it does not turn
  std::vector<double> middles;    // of the ranges
  for (std::size_t i = 0; i < closure.unknowns.size(); ++i) {
    periods.push_back(turns(closure, i) ? enclose_constant(period_of(closure, i), "a period")
                                        : Interval(0.0));
    middles.push_back(mid(enclose_constant(closure.start[i], "a range")));
  }
  Listed listed{{}, usual_sizes(solutions)};
  for (const CertainSolution& solution : solutions.found) {
    std::vector<Interval> tube = solution.values;
    std::vector<double> middle = solution.middle;
    for (std::size_t i = 0; i < tube.size(); ++i) {
      if (periods[i] == Interval(0.0)) continue;
      const double period = mid(periods[i]);
      tube[i] -= Interval(std::round((mid(tube[i]) - middles[i]) / period)) * periods[i];
      if (!middle.empty()) middle[i] = moved_near(middle[i], mid(tube[i]), period);
    }
    listed.tubes.push_back(std::move(tube));
    if (!middle.empty()) listed.middles.push_back(std::move(middle));
  }
  return listed;
}

}  // namespace

Listed list_of(const Request& request, const Solutions& solutions) {
  if (request.model.arm) return posture_list(solutions);
  if (request.model.closure) return configuration_list(request, solutions);
  return is_in_plane(request) ? planar_list(request, solutions) : pose_list(request, solutions);
}

namespace {

std::string text_of(const std::vector<std::vector<Interval>>& tubes) {
  std::string lines;
  for (const auto& tube : tubes) {
    lines += "solution";
    for (const Interval& x : tube) lines += fmt::format(" {:a}:{:a}", x.lo, x.hi);
    lines += '\n';
  }
  return lines;
}

}  // namespace

std::string lines_of(const Solutions& solutions, const Listed& listed) {
  std::vector<std::vector<Interval>> tubes = widened(solutions, listed, kWiderWidth);
  for (double part = kWiderWidth / 4; !listed.middles.empty() && part > kLeastWider; part /= 4) {
    if (are_disjoint(tubes)) break;
    tubes = widened(solutions, listed, part);
  }
  return text_of(tubes);
}

std::optional<std::string> wider_lines_of(const Solutions& solutions, const Listed& listed,
                                          double own, double widest) {
  std::vector<std::vector<Interval>> tubes = widened(solutions, listed, own);
  for (std::vector<Interval>& tube : tubes) {
    double width = 0;
    for (const Interval& x : tube) width = std::max(width, width_ru(x));
    for (Interval& x : tube) x += Interval(-widest * width, widest * width);
  }
  return are_disjoint(tubes) ? std::optional(text_of(tubes)) : std::nullopt;
}

std::string proof_of(const Listed& listed) {
  std::string lines;
  for (const auto& middle : listed.middles) {
    lines += "from";
    for (const double x : middle) lines += fmt::format(" {}", x);
    lines += '\n';
  }
  return lines + "end\n";
}

Request searched_request(const Request& request) {
  Request searched = request;
  searched.motion.alpha = 0;
  Closure& closure = *searched.model.closure;
  closure.has_range.clear();  // lines `unknown` say where solutions are looked for
  for (std::size_t i = 0; i < closure.unknowns.size(); ++i) {
    closure.start[i] = (closure.ranges[i].lo + closure.ranges[i].hi) / 2;
    closure.start_radius[i] =
        (turns(closure, i) ? period_of(closure, i) : width_of(closure, i)) / 2;
  }
  fix_parameters(searched);
  return searched;
}

double size_of(const Request& request, const Solutions& solutions) {
  double size = 0;
  for (const ex& square : squared_lengths(request))
    size = std::max(size, mag(sqrt(enclose_constant(square, "a length"))));
  for (const CertainSolution& solution : solutions.found)
    for (std::size_t i = 0; i < (is_in_plane(request) ? 2U : 3U); ++i)
      size = std::max(size, mag(solution.values[i]));
  return size;
}

}  // namespace regulus::detail
