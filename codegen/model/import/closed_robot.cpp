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
#include "codegen/model/import/idle_equations.hpp"
#include "codegen/model/import/loop_closing.hpp"
#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using Indices = std::vector<std::size_t>;

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
    tell_limits();
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
      const auto joint = std::ranges::find(mechanism_.joints, name, &ImportedJoint::name);
      if (const auto known = variable(name))
        driven_.insert(*known);
      else if (joint == mechanism_.joints.end() && is_asked)
        throw UsageError("--actuated: there is no joint " + in_quotes(name));
      else if (joint != mechanism_.joints.end() && !drive_leader(*joint))
        outside.push_back(in_quotes(name));
    }
    if (!outside.empty()) note(fmt::format("driven, but in no loop: {}", fmt::join(outside, ", ")));
  }

  /// The motor of a joint that follows another turns that one, too.
  bool drive_leader(const ImportedJoint& joint) {
    if (!joint.mimics || !joint.rule || joint.rule->multiplier.is_zero()) return false;
    const auto leader = variable(*joint.mimics);
    if (!leader) return false;
    driven_.insert(*leader);
    note(fmt::format("the motor of {} drives {}, which it follows", in_quotes(joint.name),
                     quoted({*leader})));
    return true;
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
                         " is no JOINT=VALUE with a joint of a loop that follows none");
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
    if (pose_.largest_gap() > kClosedGap) {
      const double with_motors_at_rest = pose_.largest_gap();
      pose_.values = begin;
      Indices all = passive_;
      for (const std::size_t v : motors_)
        if (!placed_.contains(v)) all.push_back(v);
      close_loops(pose_, all);
      require_closed(std::fmin(with_motors_at_rest, pose_.largest_gap()));
      round_motors();
    }
    if (open > kClosedGap) tell_moves(begin, open);
  }

  void require_closed(double gap) const {
    if (gap <= kClosedGap) return;
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
    if (nice.largest_gap() <= kClosedGap) pose_.values = nice.values;
  }

  void tell_moves(const std::vector<double>& begin, double open) {
    std::size_t most = 0;
    Indices moved;
    const auto change = [&](std::size_t v) { return std::fabs(pose_.values[v] - begin[v]); };
    for (std::size_t v = 0; v < begin.size(); ++v) {
      if (change(v) > change(most)) most = v;
      if (change(v) > kClosedGap && driven_.contains(v)) moved.push_back(v);
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
    for (const LoopVariable& v : graph_.variables)
      joints_.push_back({v.name, v.slides, 0, 0, GiNaC::realsymbol(v.name)});
    IdleEquations found = find_idle_equations(graph_, loops_, pose_, symbols(), file_);
    exact_ = std::move(found.exact);
    idle_ = std::move(found.idle);
    most_ = std::move(found.most);
    for (const std::string& text : found.notes) note(text);
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
    const bool follows = near.largest_gap() <= kClosedGap;
    if (follows && independent_rows(near, passive_, most_, idle_).rows.size() > rank)
      refuse(loops_[worst].line,
             fmt::format("the loops are closed in a singular configuration: {}", counts),
             "begin elsewhere: --at JOINT=VALUE");
    Indices all = passive_;
    all.insert(all.end(), motors_.begin(), motors_.end());
    const std::size_t whole = independent_rows(pose_, all, most_, idle_).rows.size();
    if (whole == all.size())
      refuse(loops_[worst].line,
             fmt::format("{} is rigid: the loops leave no freedom, so that no motor can move ({})",
                         loops_[worst].name, counts),
             "correct the joints, or the loops");
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
    require_idle(held);
    for (const std::size_t v : held) pose_.values[v] = rounded(pose_.values[v]);
    close_loops(pose_, unknowns_);
    require_closed(pose_.largest_gap());
    for (const std::size_t v : held) held_[joints_[v].symbol] = exact_value(v);
    note(
        fmt::format("no motor and no loop determines {}, held at {}: exact algebra shows that it "
                    "moves no more than links between pins in line; the claim is about the rest",
                    quoted(held), fmt::join(texts_of(held), ", ")));
  }

  /// With the motors locked, a held joint would move, and what it moves with it, unless the gap does
  /// not depend on it, or depends on its sum or difference with another one.
  void require_idle(const Indices& held) const {
    Indices loose;
    for (const std::size_t v : held)
      if (!is_idle_joint(v, unknowns_, pose_, exact_, symbols())) loose.push_back(v);
    if (loose.empty()) return;
    if (motors_.empty())
      throw UsageError(fmt::format(
          "the loops leave {} freedom{}; name as many driven joints: --actuated JOINT,JOINT of {}",
          loose.size(), loose.size() == 1 ? "" : "s", quoted(passive_)));
    Indices motors = motors_;
    motors.insert(motors.end(), loose.begin(), loose.end());
    std::vector<std::string> names;
    for (const std::size_t v : motors) names.push_back(graph_.variables[v].name);
    refuse(graph_.variables[loose.front()].line,
           fmt::format("the loops leave {} freedom{} that no motor holds: {} can move while the "
                       "motors are locked",
                       loose.size(), loose.size() == 1 ? "" : "s", quoted(loose)),
           fmt::format("name as many driven joints more, such as --actuated {}",
                       fmt::join(names, ",")));
  }

  /// The limits of motors and unknowns are those of the model; others are named.
  void tell_limits() {
    std::set<std::size_t> without;
    for (const CutLoop& loop : loops_)
      without.insert(loop.without_value.begin(), loop.without_value.end());
    Indices beyond, absent, counted;
    for (std::size_t v = 0; v < graph_.variables.size(); ++v) {
      if (!graph_.variables[v].limits) continue;
      if (without.contains(v) || held_.contains(joints_[v].symbol))
        absent.push_back(v);
      else
        (has_limits(v) ? counted : beyond).push_back(v);
    }
    if (!counted.empty()) note("within the limits of the file: " + quoted(counted));
    if (!beyond.empty())
      note(fmt::format(
          "the start is beyond the limits of {} in the file, which the model leaves out; "
          "--at JOINT=VALUE begins elsewhere",
          quoted(beyond)));
    if (!absent.empty())
      note("the limits of " + quoted(absent) +
           " are no part of the model, because it has no value of them");
  }

  /// True if there are limits and the start is in them.
  bool has_limits(std::size_t v) const {
    const auto& limits = graph_.variables[v].limits;
    return limits && limits->range.lower.approx() <= pose_.values[v] &&
           pose_.values[v] <= limits->range.upper.approx();
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
      to.push_back({name, variable.slides, pose_.values[v], reach_of(graph_, v),
                    GiNaC::realsymbol(name), has_limits(v) ? variable.limits : std::nullopt});
      names[joints_[v].symbol] = to.back().symbol;
    };
    Indices rows = rows_.rows;
    std::ranges::sort(rows);
    for (const std::size_t v : motors_)
      if (std::ranges::any_of(rows,
                              [&](std::size_t r) { return exact_[r].has(joints_[v].symbol); }))
        add(robot.driven, v);
      else
        note("moves no passive joint: " + quoted({v}));
    if (robot.driven.empty())
      refuse(loops_.front().line, "no driven joint is in a loop",
             "name the driven joints: --actuated JOINT,JOINT");
    for (const std::size_t v : unknowns_) add(robot.passive, v);
    for (const std::size_t row : rows) robot.equations.push_back(exact_[row].subs(names));
    robot.summary = fmt::format("{} loop{}: {} equation{} in as many passive joints; driven: {}",
                                loops_.size(), loops_.size() == 1 ? "" : "s", rows.size(),
                                rows.size() == 1 ? "" : "s", quoted(motors_));
    for (const CutLoop& loop : loops_) {
      if (!loop.at.empty())
        note(fmt::format("{}: cut at {}, whose angles are no unknowns", loop.name, loop.at));
      for (const std::string& ball : loop.made_balls)
        note(
            fmt::format("{} are taken as a ball: a pose where two of their axes are in line is no "
                        "part of the question",
                        ball));
    }
    return robot;
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
  std::vector<char> idle_;           ///< parts of the gap that are always 0, or follow
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

}  // namespace regulus::detail
