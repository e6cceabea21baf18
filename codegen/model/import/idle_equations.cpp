// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/idle_equations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "codegen/model/exact/exact_algebra.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

constexpr double kZero = 1e-11;  ///< part of a gap that is always 0, computed in doubles

class IdleFinder {
 public:
  IdleFinder(const LoopGraph& graph, const std::vector<CutLoop>& loops, const LoopPose& pose,
             const std::string& file)
      : graph_(graph), loops_(loops), pose_(pose), file_(file) {}

  IdleEquations find(const std::vector<ex>& symbols) {
    measure_gaps();
    found_.idle.assign(gaps_.front().size(), 0);
    for (const CutLoop& loop : loops_) {
      const std::size_t begin = found_.exact.size();
      for (const ex& part : gap_of(loop, graph_.joints, symbols)) found_.exact.push_back(part);
      for (std::size_t i = begin; i < found_.exact.size(); ++i)
        found_.idle[i] = is_idle(loop, {{i, 1.0, 1}}) ? 1 : 0;
      if (loop.kind == CutLoop::Kind::kBall || loop.kind == CutLoop::Kind::kHinge)
        for (std::size_t i = begin; i < found_.exact.size(); i += 3) find_idle_across(loop, i);
      found_.most.push_back(loop.equations() - dropped(loop, begin));
    }
    return std::move(found_);
  }

 private:
  /// The gaps of the closed loops, and those of other poses, where they are open.
  void measure_gaps() {
    LoopPose any = pose_;
    for (int trial = 0; trial < 4; ++trial) {
      gaps_.push_back(any.gap());
      for (std::size_t v = 0; v < any.values.size(); ++v)
        any.values[v] = pose_.values[v] + std::sin(1.7 * double(v + 1) + 2.3 * trial);
    }
  }

  struct Term {
    std::size_t part;
    double approx;
    ex factor;
  };

  /// True for a sum of parts of the gap that is 0 wherever the joints are.
  bool is_idle(const CutLoop& loop, const std::vector<Term>& sum) const {
    for (std::size_t trial = 0; trial < gaps_.size(); ++trial) {
      double value = 0;
      for (const Term& term : sum) value += term.approx * gaps_[trial][term.part];
      if (std::fabs(value) > (trial == 0 ? kClosedGap : kZero)) return false;
    }
    ex exact = 0;
    for (const Term& term : sum) exact += term.factor * found_.exact[term.part];
    if (!is_certainly_zero(exact))
      throw InputError::statement(
          file_, loop.line,
          fmt::format("{} has an equation that is nearly always true, but not exactly", loop.name),
          "its numbers are rounded; a larger --snap may make its joints parallel");
    return true;
  }

  /// A loop may keep its plane where that is no coordinate plane. Its joints in the middle, whose
  /// frame the gap is seen from, are then across it. A vector without a component across the plane
  /// is 0 if two of its parts are; the third must have a share in that component.
  void find_idle_across(const CutLoop& loop, std::size_t begin) {
    if (found_.idle[begin] + found_.idle[begin + 1] + found_.idle[begin + 2] > 0) return;
    for (const auto* way : {&loop.arc.left, &loop.arc.right}) {
      if (way->empty() || way->front().kind != LoopStep::Kind::kJoint) continue;
      const LoopJoint& joint = graph_.joints[way->front().joint];
      std::vector<Term> sum;
      std::size_t most = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        sum.push_back({begin + i, joint.approx_axis[i], joint.axis[i]});
        if (std::fabs(joint.approx_axis[i]) > std::fabs(joint.approx_axis[most])) most = i;
      }
      if (!is_idle(loop, sum)) continue;
      found_.idle[begin + most] = 1;
      return;
    }
  }

  /// Returns how many equations the idle parts of a loop stand for.
  ///
  /// Hinge     the directions of an axis on both sides have one component that is the same: then the
  ///           other two have the same length, and only its turn is left.
  /// Weld      two rotations have a row, or a column, that is the same: then they differ by a turn
  ///           about it.
  std::size_t dropped(const CutLoop& loop, std::size_t begin) {
    if (loop.kind == CutLoop::Kind::kRod) return 0;
    const auto count_of = [&](std::size_t from, std::size_t step) -> std::size_t {
      return std::size_t(found_.idle[begin + from]) +
             std::size_t(found_.idle[begin + from + step]) +
             std::size_t(found_.idle[begin + from + 2 * step]);
    };
    std::size_t count = count_of(0, 1);
    if (loop.kind == CutLoop::Kind::kHinge) count += std::min<std::size_t>(count_of(3, 1), 2);
    if (loop.kind == CutLoop::Kind::kWeld) {
      std::size_t lines = 0;
      for (std::size_t i = 0; i < 3; ++i)
        lines += (count_of(3 + i, 3) == 3 ? 1U : 0U) + (count_of(3 + 3 * i, 1) == 3 ? 1U : 0U);
      count += lines == 6 ? 3 : lines > 0 ? 2 : 0;
    }
    if (count > 0)
      found_.notes.push_back(fmt::format("{}: {} of {} equations are always true and were dropped",
                                         loop.name, count, loop.equations()));
    return count;
  }

  const LoopGraph& graph_;
  const std::vector<CutLoop>& loops_;
  const LoopPose& pose_;
  const std::string& file_;
  std::vector<std::vector<double>> gaps_;  ///< at some poses
  IdleEquations found_;
};

/// True if the gap has no derivative along a direction, wherever the joints are.
bool has_no_slope(const std::vector<std::pair<std::size_t, int>>& direction, const LoopPose& pose,
                  const std::vector<ex>& exact, const std::vector<ex>& symbols) {
  LoopPose any = pose;
  for (std::size_t i = 0; i < any.values.size(); ++i)
    any.values[i] += std::sin(1.3 * double(i + 1));
  std::vector<std::size_t> by;
  for (const auto& [v, sign] : direction) by.push_back(v);
  const std::vector<double> slopes = any.slopes(by);
  for (std::size_t r = 0; r < exact.size(); ++r) {
    double slope = 0;
    for (std::size_t i = 0; i < by.size(); ++i)
      slope += direction[i].second * slopes[r * by.size() + i];
    if (std::fabs(slope) > 1e-7) return false;
  }
  return std::ranges::all_of(exact, [&](const ex& part) {
    ex slope = 0;
    for (const auto& [v, sign] : direction)
      slope += sign * part.diff(GiNaC::ex_to<GiNaC::symbol>(symbols[v]));
    return is_certainly_zero(slope);
  });
}

}  // namespace

IdleEquations find_idle_equations(const LoopGraph& graph, const std::vector<CutLoop>& loops,
                                  const LoopPose& pose, const std::vector<ex>& symbols,
                                  const std::string& file) {
  return IdleFinder(graph, loops, pose, file).find(symbols);
}

bool is_idle_joint(std::size_t v, const std::vector<std::size_t>& others, const LoopPose& pose,
                   const std::vector<ex>& exact, const std::vector<ex>& symbols) {
  if (has_no_slope({{v, 1}}, pose, exact, symbols)) return true;
  return std::ranges::any_of(others, [&](std::size_t other) {
    return has_no_slope({{v, 1}, {other, 1}}, pose, exact, symbols) ||
           has_no_slope({{v, 1}, {other, -1}}, pose, exact, symbols);
  });
}

double reach_of(const LoopGraph& graph, std::size_t variable) {
  for (const Loop& loop : graph.loops) {
    double length = 0;
    bool is_in_loop = false;
    for (const LoopStep& step : loop.steps) {
      if (step.kind == LoopStep::Kind::kFixed)
        length += std::hypot(step.approx[9], step.approx[10], step.approx[11]);
      if (step.kind == LoopStep::Kind::kJoint)
        is_in_loop = is_in_loop || graph.joints[step.joint].variable == variable;
    }
    if (is_in_loop) return length / 100;
  }
  return 0;
}

}  // namespace regulus::detail
