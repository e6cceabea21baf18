// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/closed_robot.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "codegen/model/exact/expression_parser.hpp"
#include "codegen/model/import/loop_closing.hpp"
#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"

namespace regulus {
namespace {

using GiNaC::ex;
using Indices = std::vector<std::size_t>;

constexpr double kClosed = 1e-9;  ///< a larger gap is open
constexpr double kZero = 1e-11;   ///< part of a gap that is always 0, computed in doubles

/// A value with six decimals.
double rounded(double x) { return std::round(x * 1e6) / 1e6; }

std::string degrees(double radians) {
  return fmt::format("{:.4g} deg", radians * 180 / std::numbers::pi);
}

class RobotCloser {
 public:
  RobotCloser(Mechanism& mechanism, const std::string& file, const ClosureWishes& wishes,
              Identifiers& identifiers)
      : mechanism_(mechanism),
        file_(file),
        wishes_(wishes),
        identifiers_(identifiers),
        graph_(find_loops(mechanism, file)) {}

  std::optional<ClosedRobot> close() {
    if (graph_.loops.empty()) return std::nullopt;
    find_driven();
    loops_ = cut_loops(graph_, driven_, file_);
    find_passive();
    pose_.values.assign(graph_.variables.size(), 0);
    read_start();
    close_start();
    find_idle();
    choose_rows();
    hold();
    return write();
  }

 private:
  [[noreturn]] void refuse(int line, const std::string& problem, const std::string& remedy) const {
    throw InputError::statement(file_, line, problem, remedy);
  }
  void note(const std::string& text) { mechanism_.notes.push_back(text); }

  std::string quoted(const Indices& variables) const {
    std::vector<std::string> names;
    for (const std::size_t v : variables) names.push_back(in_quotes(graph_.variables[v].name));
    return fmt::format("{}", fmt::join(names, ", "));
  }

  std::optional<std::size_t> variable(const std::string& name) const {
    const auto at = std::ranges::find(graph_.variables, name, &LoopVariable::name);
    if (at == graph_.variables.end()) return std::nullopt;
    return std::size_t(at - graph_.variables.begin());
  }

  void find_driven() {
    const bool is_asked = !wishes_.driven.empty();
    Indices elsewhere;
    std::vector<std::string> outside;
    for (const std::string& name : is_asked ? wishes_.driven : mechanism_.actuated) {
      if (const auto known = variable(name))
        driven_.insert(*known);
      else if (std::ranges::find(mechanism_.joints, name, &ImportedJoint::name) !=
               mechanism_.joints.end())
        outside.push_back(in_quotes(name));
      else if (is_asked)
        throw UsageError("--actuated: there is no joint " + in_quotes(name));
    }
    if (!outside.empty())
      note(fmt::format("driven, but in no loop, or follows another joint: {}",
                       fmt::join(outside, ", ")));
  }

  void find_passive() {
    std::set<std::size_t> used;
    for (const CutLoop& loop : loops_)
      for (const LoopArc* arc : {&loop.arc, &loop.other})
        for (const auto* steps : {&arc->left, &arc->right})
          for (const LoopStep& step : *steps)
            if (step.kind == LoopStep::Kind::kJoint)
              used.insert(graph_.joints[step.joint].variable);
    for (const std::size_t v : used) (driven_.contains(v) ? motors_ : passive_).push_back(v);
    for (const std::size_t v : driven_)
      if (!used.contains(v)) note("moves no loop: " + quoted({v}));
  }

  void read_start() {
    for (const std::string& at : wishes_.at) {
      const std::size_t equals = at.find('=');
      const auto known = variable(at.substr(0, equals));
      if (equals == std::string::npos || !known)
        throw UsageError("--at: " + in_quotes(at) +
                         " is no JOINT=VALUE with a joint of a loop, such as " +
                         graph_.variables.front().name + "=0.1");
      const ex value = parse_constant(at.substr(equals + 1), {.file = "--at", .key = at}).value;
      pose_.values[*known] = WrittenNumber{value, ""}.approx();
      placed_.insert(*known);
    }
  }

  /// With the motors where they are; if that is impossible, the motors move too.
  void close_start() {
    const std::vector<double> begin = pose_.values;
    const double open = pose_.largest_gap();
    close_loops(pose_, passive_);
    if (pose_.largest_gap() > kClosed) {
      const double with_motors_at_rest = pose_.largest_gap();
      pose_.values = begin;
      Indices all = passive_;
      for (const std::size_t v : motors_)
        if (!placed_.contains(v)) all.push_back(v);
      close_loops(pose_, all);
      require_closed(std::fmin(with_motors_at_rest, pose_.largest_gap()));
      round_motors();
    }
    if (open > kClosed) tell_moves(begin, open);
  }

  void require_closed(double gap) const {
    if (gap <= kClosed) return;
    std::size_t worst = 0;
    for (std::size_t i = 1; i < loops_.size(); ++i)
      if (pose_.gap_of_loop(i) > pose_.gap_of_loop(worst)) worst = i;
    std::set<std::string> joints;
    std::size_t freedoms = 0;
    for (const LoopStep& step : graph_.loops[worst].steps) {
      if (step.kind == LoopStep::Kind::kBall) freedoms += 3;
      if (step.kind == LoopStep::Kind::kJoint)
        ++freedoms, joints.insert(in_quotes(graph_.joints[step.joint].name));
    }
    refuse(loops_[worst].line,
           fmt::format("{} cannot be closed: from the file's pose Newton's method ends where it is "
                       "open by {:.3g}; {} freedoms of its joints ({}) meet six conditions",
                       loops_[worst].name, pose_.gap_of_loop(worst), freedoms,
                       fmt::join(joints, ", ")),
           "give a pose nearby, --at JOINT=VALUE, for motors or passive joints, or correct the "
           "joints");
  }

  void round_motors() {
    LoopPose nice = pose_;
    for (const std::size_t v : motors_) nice.values[v] = rounded(nice.values[v]);
    close_loops(nice, passive_);
    if (nice.largest_gap() <= kClosed) pose_.values = nice.values;
  }

  void tell_moves(const std::vector<double>& begin, double open) {
    std::size_t most = 0;
    Indices moved;
    const auto change = [&](std::size_t v) { return std::fabs(pose_.values[v] - begin[v]); };
    for (std::size_t v = 0; v < begin.size(); ++v) {
      if (change(v) > change(most)) most = v;
      if (change(v) > kClosed && driven_.contains(v)) moved.push_back(v);
    }
    note(fmt::format(
        "the loops are open by {:.3g} in the file's pose; they close where {} has moved "
        "by {}, and no joint by more",
        open, quoted({most}),
        graph_.variables[most].slides ? fmt::format("{:.4g} m", change(most))
                                      : degrees(change(most))));
    if (!moved.empty())
      note("these motors had to move for it: " + quoted(moved) + "; --at JOINT=VALUE sets them");
  }

  std::vector<ex> symbols() const {
    std::vector<ex> all;
    for (const ClosedJoint& joint : joints_) all.push_back(joint.symbol);
    return all;
  }

  /// Parts of gaps that are 0 wherever the joints are: a planar loop stays in its plane.
  void find_idle() {
    for (const LoopVariable& v : graph_.variables) {
      joints_.push_back({v.name, v.slides, 0, 0, GiNaC::realsymbol(v.name)});
    }
    idle_.assign(pose_.gap().size(), 1);
    LoopPose any = pose_;
    for (int trial = 0; trial < 4; ++trial) {
      const std::vector<double> gap = any.gap();
      for (std::size_t i = 0; i < gap.size(); ++i)
        if (std::fabs(gap[i]) > (trial == 0 ? kClosed : kZero)) idle_[i] = 0;
      for (std::size_t v = 0; v < any.values.size(); ++v)
        any.values[v] = pose_.values[v] + std::sin(1.7 * double(v + 1) + 2.3 * trial);
    }
    std::size_t begin = 0;
    for (const CutLoop& loop : loops_) {
      const std::vector<ex> exact = gap_of(loop, graph_.joints, symbols());
      std::size_t positions = 0, turns = 0;
      for (std::size_t i = 0; i < exact.size(); ++i) {
        exact_.push_back(exact[i]);
        if (idle_[begin + i] == 0) continue;
        if (!is_certainly_zero(exact[i]))
          refuse(loop.line,
                 fmt::format("{} has an equation that is nearly always true, but not exactly",
                             loop.name),
                 "its numbers are rounded; a larger --snap may make its joints parallel");
        ++(i < 3 ? positions : turns);
      }
      most_.push_back(loop.equations() - dropped(loop, positions, turns));
      begin += exact.size();
    }
  }

  /// Returns how many equations the idle parts stand for. Two rotations that differ by a turn in a
  /// plane agree in five of nine entries.
  std::size_t dropped(const CutLoop& loop, std::size_t positions, std::size_t turns) {
    if (loop.kind == CutLoop::Kind::kRod) return 0;
    std::size_t count = positions;
    if (loop.kind == CutLoop::Kind::kHinge) count += turns == 3 ? 2 : 0;
    if (loop.kind == CutLoop::Kind::kWeld) count += turns == 9 ? 3 : turns >= 5 ? 2 : 0;
    if (count > 0)
      note(fmt::format("{}: {} of {} equations are always true and were dropped", loop.name, count,
                       loop.equations()));
    return count;
  }

  void choose_rows() {
    rows_ = independent_rows(pose_, passive_, most_, idle_);
    std::size_t needed = 0;
    for (const std::size_t count : most_) needed += count;
    if (rows_.rows.size() < needed) refuse_rank(needed);
    if (needed == 0) refuse(loops_.front().line, "the loops have no equation", "open them");
  }

  [[noreturn]] void refuse_rank(std::size_t needed) const {
    const std::size_t rank = rows_.rows.size();
    std::size_t worst = 0;
    while (rows_.by_loop[worst] == most_[worst]) ++worst;
    const std::string counts = fmt::format("{} equations, {} passive joints, rank {} at the start",
                                           needed, passive_.size(), rank);
    LoopPose near = pose_;
    for (std::size_t i = 0; i < motors_.size(); ++i)
      near.values[motors_[i]] += 0.01 * std::cos(1.3 * double(i + 1));
    close_loops(near, passive_);
    const bool follows = near.largest_gap() <= kClosed;
    if (follows && independent_rows(near, passive_, most_, idle_).rows.size() > rank)
      refuse(loops_[worst].line,
             fmt::format("the loops are closed in a singular configuration: {}", counts),
             "begin elsewhere: --at JOINT=VALUE");
    Indices all = passive_;
    all.insert(all.end(), motors_.begin(), motors_.end());
    const std::size_t whole = independent_rows(pose_, all, most_, idle_).rows.size();
    if (all.size() - whole < motors_.size())
      refuse(loops_[worst].line,
             fmt::format("the loops leave {} freedoms for {} motors, {}: {}", all.size() - whole,
                         motors_.size(), quoted(motors_), counts),
             "name motors that move independently: --actuated JOINT,JOINT");
    refuse(
        loops_[worst].line,
        fmt::format("equations of {} follow from others near the start, which exact algebra does "
                    "not show: {}",
                    loops_[worst].name, counts),
        "only equations that are always true are dropped; open the loops that hold nothing more");
  }

  /// Joints that the loops leave free where the motors are locked.
  void hold() {
    std::set<std::size_t> determined;
    for (const std::size_t column : rows_.columns) determined.insert(passive_[column]);
    Indices held;
    for (const std::size_t v : passive_)
      if (!determined.contains(v)) held.push_back(v);
    unknowns_.assign(determined.begin(), determined.end());
    if (held.empty()) return;
    if (motors_.empty())
      throw UsageError(fmt::format(
          "the loops leave {} freedom{}; name as many driven joints: --actuated JOINT,JOINT of {}",
          held.size(), held.size() == 1 ? "" : "s", quoted(passive_)));
    for (const std::size_t v : held) pose_.values[v] = rounded(pose_.values[v]);
    close_loops(pose_, unknowns_);
    require_closed(pose_.largest_gap());
    for (const std::size_t v : held) held_[joints_[v].symbol] = exact_value(v);
    note(fmt::format("no motor and no loop determines {}, held at {}; the claim is about the rest",
                     quoted(held), fmt::join(texts_of(held), ", ")));
  }

  std::vector<std::string> texts_of(const Indices& variables) const {
    std::vector<std::string> texts;
    for (const std::size_t v : variables) texts.push_back(fmt::format("{:.6g}", pose_.values[v]));
    return texts;
  }

  ex exact_value(std::size_t v) const {
    return exact_number(fmt::format("{:.6f}", pose_.values[v]), {file_, 0, "the start"});
  }

  ClosedRobot write() {
    ClosedRobot robot;
    GiNaC::exmap names = held_;
    const auto add = [&](std::vector<ClosedJoint>& to, std::size_t v) {
      const LoopVariable& variable = graph_.variables[v];
      const std::string name = identifiers_.of(variable.name);
      to.push_back({name, variable.slides, pose_.values[v], reach_of(v), GiNaC::realsymbol(name)});
      names[joints_[v].symbol] = to.back().symbol;
    };
    Indices rows = rows_.rows;
    std::ranges::sort(rows);
    for (const std::size_t v : motors_)
      if (std::ranges::any_of(rows,
                              [&](std::size_t r) { return exact_[r].has(joints_[v].symbol); }))
        add(robot.driven, v);
    if (robot.driven.empty())
      refuse(loops_.front().line, "no driven joint is in a loop",
             "name the driven joints: --actuated JOINT,JOINT");
    for (const std::size_t v : unknowns_) add(robot.passive, v);
    for (const std::size_t row : rows) robot.equations.push_back(exact_[row].subs(names));
    robot.summary = fmt::format("{} loop{}: {} equation{} in as many passive joints; driven: {}",
                                loops_.size(), loops_.size() == 1 ? "" : "s", rows.size(),
                                rows.size() == 1 ? "" : "s", quoted(motors_));
    for (const CutLoop& loop : loops_)
      if (!loop.at.empty())
        note(fmt::format("{}: cut at {}, whose angles are no unknowns", loop.name, loop.at));
    return robot;
  }

  /// A hundredth of the length of a loop that the joint is in.
  double reach_of(std::size_t v) const {
    for (const Loop& loop : graph_.loops) {
      double length = 0;
      bool is_in_loop = false;
      for (const LoopStep& step : loop.steps) {
        if (step.kind == LoopStep::Kind::kFixed)
          length += std::hypot(step.approx[9], step.approx[10], step.approx[11]);
        if (step.kind == LoopStep::Kind::kJoint)
          is_in_loop = is_in_loop || graph_.joints[step.joint].variable == v;
      }
      if (is_in_loop) return length / 100;
    }
    return 0;
  }

  Mechanism& mechanism_;
  const std::string& file_;
  const ClosureWishes& wishes_;
  Identifiers& identifiers_;
  const LoopGraph graph_;
  std::set<std::size_t> driven_, placed_;
  std::vector<CutLoop> loops_;
  Indices passive_, motors_, unknowns_;
  LoopPose pose_{loops_, graph_.joints, {}};
  std::vector<ClosedJoint> joints_;  ///< by variable
  std::vector<ex> exact_;            ///< the gap
  std::vector<char> idle_;           ///< parts of it
  Indices most_;                     ///< equations of each loop
  IndependentRows rows_;
  GiNaC::exmap held_;
};

}  // namespace

std::optional<ClosedRobot> find_closed_robot(Mechanism& mechanism, const std::string& file,
                                             const ClosureWishes& wishes,
                                             Identifiers& identifiers) {
  return RobotCloser(mechanism, file, wishes, identifiers).close();
}

}  // namespace regulus
