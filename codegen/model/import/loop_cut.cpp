// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/loop_cut.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using Kind = LoopStep::Kind;
using Steps = std::vector<LoopStep>;

class LoopCutter {
 public:
  LoopCutter(const LoopGraph& graph, const std::set<std::size_t>& driven, const std::string& file)
      : graph_(graph), driven_(driven), file_(file) {
    for (const Loop& loop : graph.loops)
      for (const LoopStep& step : loop.steps) {
        if (step.kind == Kind::kBall) ++balls_[step.name];
        if (step.kind == Kind::kJoint) ++uses_[graph.joints[step.joint].variable];
      }
  }

  CutLoop cut(const Loop& loop) const {
    Steps steps = with_balls(loop.steps);
    std::vector<std::size_t> balls;
    for (std::size_t i = 0; i < steps.size(); ++i)
      if (steps[i].kind == Kind::kBall) {
        require_own(steps[i], loop);
        balls.push_back(i);
      }
    CutLoop result;
    result.name = loop.name;
    result.line = loop.line;
    for (const std::size_t ball : balls) {
      if (!steps[ball].hinges.empty()) result.made_balls.push_back(steps[ball].name);
      for (const std::size_t joint : steps[ball].hinges)
        result.without_value.push_back(graph_.joints[joint].variable);
    }
    if (balls.size() > 2)
      throw InputError::statement(file_, loop.line,
                                  fmt::format("{} has {} balls", loop.name, balls.size()),
                                  "what is between them is not held; a loop has at most two");
    if (balls.size() == 2) return rod(std::move(result), steps, balls[0], balls[1]);
    if (balls.size() == 1) {
      result.kind = CutLoop::Kind::kBall;
      result.at = steps[balls[0]].name;
      result.arc = balanced(after(steps, balls[0]));
    } else if (const auto hinge = own_hinge(loop)) {
      result.kind = CutLoop::Kind::kHinge;
      result.hinge = loop.steps[*hinge].joint;
      result.without_value.push_back(graph_.joints[result.hinge].variable);
      result.at = in_quotes(graph_.joints[result.hinge].name);
      result.arc = balanced(after(loop.steps, *hinge));
    } else {
      result.arc = balanced(steps);
    }
    return result;
  }

 private:
  [[nodiscard]] bool is_own(const LoopStep& step) const {
    if (step.kind != Kind::kJoint) return false;
    const LoopJoint& joint = graph_.joints[step.joint];
    return !joint.slides && !joint.follows && !driven_.contains(joint.variable) &&
           uses_.at(joint.variable) == 1;
  }

  void require_own(const LoopStep& ball, const Loop& loop) const {
    if (ball.hinges.empty() && balls_.at(ball.name) > 1)
      throw InputError::statement(file_, loop.line,
                                  fmt::format("the ball {} is in two loops", ball.name),
                                  "write it as three joints that turn about one point");
  }

  /// Three joints of one loop that turn about one point, each at a right angle to the next, are a
  /// ball: they have all orientations.
  Steps with_balls(const Steps& steps) const {
    Steps result;
    for (std::size_t i = 0; i < steps.size();) {
      const auto hinges = hinges_of_ball(steps, i);
      if (!hinges) {
        result.push_back(steps[i++]);
        continue;
      }
      LoopStep ball;
      ball.kind = Kind::kBall;
      for (const std::size_t at : *hinges) {
        ball.hinges.push_back(steps[at].joint);
        ball.name +=
            (ball.name.empty() ? "" : ", ") + in_quotes(graph_.joints[steps[at].joint].name);
      }
      result.push_back(std::move(ball));
      i = hinges->back() + 1;
    }
    return result;
  }

  /// Returns where three such joints are that begin at a step; what is between them keeps the point.
  std::optional<std::vector<std::size_t>> hinges_of_ball(const Steps& steps,
                                                         std::size_t begin) const {
    std::vector<std::size_t> hinges;
    std::array<double, 9> turn = {1, 0, 0, 0, 1, 0, 0, 0, 1};  // since the last joint
    for (std::size_t i = begin; i < steps.size() && hinges.size() < 3; ++i) {
      const LoopStep& step = steps[i];
      if (step.kind == Kind::kFixed) {
        if (hinges.empty()) return std::nullopt;
        if (!std::ranges::all_of(step.frame.p, [](const GiNaC::ex& x) { return x.is_zero(); }))
          return std::nullopt;
        turn = product(turn, step.approx);
        continue;
      }
      if (!is_own(step)) return std::nullopt;
      if (!hinges.empty() &&
          !are_perpendicular(graph_.joints[steps[hinges.back()].joint].approx_axis, turn,
                             graph_.joints[step.joint].approx_axis))
        return std::nullopt;
      hinges.push_back(i);
      turn = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    }
    return hinges.size() == 3 ? std::optional(hinges) : std::nullopt;
  }

  template <std::size_t size>
  static std::array<double, 9> product(const std::array<double, 9>& a,
                                       const std::array<double, size>& b) {
    std::array<double, 9> c{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k) c[i * 3 + j] += a[i * 3 + k] * b[k * 3 + j];
    return c;
  }

  /// u and R·v.
  static bool are_perpendicular(const std::array<double, 3>& u, const std::array<double, 9>& R,
                                const std::array<double, 3>& v) {
    double cosine = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) cosine += u[i] * R[i * 3 + j] * v[j];
    return std::fabs(cosine) < 1e-9;
  }

  /// A joint without limits, if there is one: the nearest to where the file's tree is closed, because
  /// often two in line meet there.
  std::optional<std::size_t> own_hinge(const Loop& loop) const {
    std::optional<std::size_t> nearest;
    const auto distance = [this, &loop](std::size_t i) {
      const std::size_t variable = graph_.joints[loop.steps[i].joint].variable;
      return std::pair(graph_.variables[variable].limits.has_value(),
                       std::abs(2 * std::ptrdiff_t(i) + 1 - 2 * std::ptrdiff_t(loop.closes_at)));
    };
    for (std::size_t i = 0; i < loop.steps.size(); ++i)
      if (is_own(loop.steps[i]) && (!nearest || distance(i) < distance(*nearest))) nearest = i;
    return nearest;
  }

  /// The way around the loop from behind a step to before it.
  static Steps after(const Steps& steps, std::size_t at) {
    Steps result(steps.begin() + std::ptrdiff_t(at) + 1, steps.end());
    result.insert(result.end(), steps.begin(), steps.begin() + std::ptrdiff_t(at));
    return result;
  }

  /// Seen from the frame of a joint in the middle: planar loops then have a coordinate plane.
  static LoopArc balanced(const Steps& steps) {
    const auto joints = std::ranges::count(steps, Kind::kJoint, &LoopStep::kind);
    std::size_t best = 0;
    std::ptrdiff_t passed = 0, least = joints + 1;
    for (std::size_t i = 0; i <= steps.size(); ++i) {
      const bool before = i < steps.size() && steps[i].kind == Kind::kJoint;
      const bool behind = i > 0 && steps[i - 1].kind == Kind::kJoint;
      if (behind) ++passed;
      if ((before || behind) && std::abs(2 * passed - joints) < least)
        least = std::abs(2 * passed - joints), best = i;
    }
    const auto middle = steps.begin() + std::ptrdiff_t(best);
    return {reversed(Steps(steps.begin(), middle)), Steps(middle, steps.end())};
  }

  static CutLoop rod(CutLoop result, const Steps& steps, std::size_t first, std::size_t second) {
    result.kind = CutLoop::Kind::kRod;
    result.at = steps[first].name + " and " + steps[second].name;
    const auto at = steps.begin();
    Steps inner(at + std::ptrdiff_t(first) + 1, at + std::ptrdiff_t(second));
    Steps outer(at + std::ptrdiff_t(second) + 1, steps.end());
    outer.insert(outer.end(), at, at + std::ptrdiff_t(first));
    result.arc = balanced(inner);
    result.other = balanced(outer);
    return result;
  }

  const LoopGraph& graph_;
  const std::set<std::size_t>& driven_;
  const std::string& file_;
  std::map<std::string, int> balls_;  ///< uses, by name
  std::map<std::size_t, int> uses_;   ///< of variables in all loops
};

}  // namespace

std::size_t CutLoop::equations() const {
  switch (kind) {
    case Kind::kBall:
      return 3;
    case Kind::kHinge:
      return 5;
    case Kind::kWeld:
      return 6;
    case Kind::kRod:
      break;
  }
  return 1;
}

std::vector<CutLoop> cut_loops(const LoopGraph& graph, const std::set<std::size_t>& driven,
                               const std::string& file) {
  const LoopCutter cutter(graph, driven, file);
  std::vector<CutLoop> result;
  for (const Loop& loop : graph.loops) result.push_back(cutter.cut(loop));
  return result;
}

}  // namespace regulus::detail
