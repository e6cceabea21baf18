// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/arm_postures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/degrees.hpp"
#include "codegen/model/names.hpp"
#include "codegen/model/place.hpp"
#include "codegen/question/solve/arm_system.hpp"
#include "codegen/question/solve/platform_legs.hpp"
#include "codegen/question/solve/root_search.hpp"
#include "codegen/question/solve/system_solutions.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/interval/floating_point_scope.hpp"
#include "runtime/solutions/arm_postures.hpp"

namespace regulus {
namespace {

constexpr const char* kTheorem =
    "by the theorem that six joints that turn have at most 16 isolated complex postures (Primrose "
    "1986; Lee & Liang 1988; Raghavan & Roth 1993), of which 16 are certain";
constexpr std::size_t kWays = 3;
/// Each way to choose opposite joints gets so many boxes at first, and then all that are left.
constexpr std::uint64_t kFirstBoxes = 3000;
/// After a box that cannot be split: each way then only looks for more postures that are certain.
constexpr std::uint64_t kBoxesAfterProblem = 4000;
constexpr double kOverlapOfTurn = 0x1p-8;  ///< of the search over a turn, in radians
/// E is no half turn if 3 less its trace is below this.
constexpr double kHalfTurn = 4;
const Interval kTurn = Interval(2.0) * kPi;
/// The four joints of OppositeAxes among six, and the other two.
constexpr std::array<std::size_t, 4> kSearched = {0, 1, 3, 4};
constexpr std::array<std::size_t, 2> kFollowing = {2, 5};

class ArmSolver {
 public:
  ArmSolver(const Request& request, const SolveRun& run)
      : model_(request.model),
        run_(run),
        geometry_(has_tolerances(request) && !has_errors(request.motion)
                      ? ArmGeometry::kWithinTolerances
                      : ArmGeometry::kNominal),
        chain_(enclose_chain(model_, geometry_)) {
    const FloatingPointScope nearest(FloatingPointRounding::kNearest);
    for (const SerialJoint& joint : model_.arm->joints)
      if (joint.follows)
        throw UsageError("the postures of an arm with joints that follow others are not found");
    const bool is_by_tool = !request.motion.tool.empty();
    const std::vector<std::string> held = held_joints(request.motion, run.held);
    const std::vector<Interval> values = enclose_values(model_, request.motion);
    free_.resize(chain_.size());
    std::iota(free_.begin(), free_.end(), std::size_t{0});
    target_ = is_by_tool ? enclose_target(model_, request.motion.tool, geometry_)
                         : posture_at(enclose_chain(model_, ArmGeometry::kNominal), values).end;
    for (const std::string& name : held) hold(name, values);
    if (chain_.size() != kJoints)
      throw UsageError(fmt::format(
          "{} joints are free to move, and a frame fixes six; {}", chain_.size(),
          chain_.size() < kJoints ? "postures are found of arms with six"
          : is_by_tool
              ? "give values that some keep, such as at " + model_.pose.back().name + "=VALUE"
              : "name some that keep their values by hold"));
    for (const std::size_t i : free_)
      solutions_.unknowns.push_back({model_.pose[i].name, model_.pose[i].unit,
                                     !turns(i)       ? 0
                                     : in_degrees(i) ? 360
                                                     : mid(kTurn)});
  }

  Solutions solve() {
    run_.begin();
    settings_ = root_settings_of(run_);
    settings_.boxes_after_problem = kBoxesAfterProblem;
    const FloatingPointScope nearest(FloatingPointRounding::kNearest);
    const bool all_turn = std::ranges::all_of(chain_, &ArmJoint::turns);
    Attempt best = all_turn ? by_opposite_axes() : by_all_joints();
    for (Root& root : best.postures) add(root);
    sort_by_values(solutions_.found);
    for (std::vector<Interval>& box : best.open)
      for (std::size_t k = 0; k < kJoints; ++k) box[k] = in_unit(k, box[k]);
    solutions_.open = std::move(best.open);
    solutions_.completeness =
        best.obstacle.empty() ? Completeness::kComplete : Completeness::kIncomplete;
    solutions_.obstacle = std::move(best.obstacle);
    solutions_.stopped_by = best.stopped_by;
    solutions_.how = is_counted_
                         ? kTheorem
                         : fmt::format("by a search of {} box{}", in_thousands(solutions_.boxes),
                                       solutions_.boxes == 1 ? "" : "es");
    return std::move(solutions_);
  }

 private:
  struct Attempt {
    std::vector<Root> postures;  ///< of all six joints, in radians
    std::vector<std::vector<Interval>> open;
    std::string obstacle;  ///< empty: the list is whole
    std::optional<Reason> stopped_by{};
  };

  /// Returns the joints of the option, and those to which a motion by the tool gives a value.
  [[nodiscard]] std::vector<std::string> held_joints(const Motion& motion,
                                                     std::vector<std::string> names) const {
    for (std::size_t i = 0; i < model_.pose.size() && !motion.tool.empty(); ++i) {
      const std::string& name = model_.pose[i].name;
      const bool is_named = std::ranges::find(names, name) != names.end();
      if (is_named && !keeps_value(model_, motion, i))
        throw UsageError(fmt::format(
            "{} is held, and has no value; give it beside the place of the tool, at {}=VALUE",
            in_quotes(name), name));
      if (!is_named && keeps_value(model_, motion, i)) names.push_back(name);
    }
    return names;
  }

  [[nodiscard]] bool turns(std::size_t joint) const {
    return model_.arm->joints[joint].kind == JointKind::kRevolute;
  }
  [[nodiscard]] bool in_degrees(std::size_t joint) const {
    return turns(joint) && is_in_degrees(model_.pose[joint].unit);
  }

  /// Returns the value of a joint of the chain in the unit of the report.
  [[nodiscard]] Interval in_unit(std::size_t joint, const Interval& value) const {
    return in_degrees(free_[joint]) ? Interval(180.0) * value / kPi : value;
  }

  /// Makes a joint a part of the link behind it.
  void hold(const std::string& name, const std::vector<Interval>& values) {
    const auto at =
        std::ranges::find(free_, name, [this](std::size_t i) { return model_.pose[i].name; });
    if (at == free_.end()) throw UsageError("no joint " + in_quotes(name) + " is free to be held");
    const std::size_t i = *at;
    const auto k = std::size_t(at - free_.begin());
    const LinkFrame link = compose(chain_[k].origin, chain_[k].moved(values[i]));
    if (k + 1 < chain_.size())
      chain_[k + 1].origin = compose(link, chain_[k + 1].origin);
    else
      target_ = compose(target_, inverse(link));
    chain_.erase(chain_.begin() + std::ptrdiff_t(k));
    free_.erase(at);
  }

  [[nodiscard]] bool varies() const { return geometry_ != ArmGeometry::kNominal; }

  /// The whole arm near a posture. Nothing of the question but its sizes is read.
  [[nodiscard]] RootJudge judge_of_arm() const {
    const auto arm = [this] { return std::make_unique<WholeArm>(chain_, target_, varies()); };
    return RootJudge({problem_, {0, 0, kJoints, 0}, arm});
  }

  /// True if E at a solution of WholeArm is the unit matrix, and not a half turn.
  [[nodiscard]] bool is_posture(const Root& root) const {
    WholeArm arm(chain_, target_);
    const std::vector<RootSystem::Box> boxes = {root.values};
    arm.evaluate(boxes, false);
    return arm.at(0)->also.front().hi < kHalfTurn;
  }

  /// All postures, if as many as the theorem allows are certain among complex numbers.
  std::optional<Attempt> by_counting() {
    if (varies()) return std::nullopt;
    ArmToEnd arm;
    for (std::size_t k = 0; k < kJoints; ++k)
      arm.joints[k] = {{chain_[k].origin.R, chain_[k].origin.d}, chain_[k].axis};
    arm.end = {target_.R, target_.d};
    const ArmPostures counted = find_arm_postures(arm);
    if (!counted.is_complete()) return std::nullopt;
    Attempt attempt;
    for (const PostureAngles& angles : counted.postures) {
      std::vector<double> near;
      for (const Interval& angle : angles) near.push_back(mid(angle));
      auto root = judge_of_arm().root_near({}, near);
      if (!root || !is_posture(*root) || !root->is(angles)) return std::nullopt;
      attempt.postures.push_back(std::move(*root));
    }
    solutions_.complex_found = counted.complex;
    is_counted_ = true;
    return attempt;
  }

  Attempt by_opposite_axes() {
    Attempt best;
    const std::uint64_t all = settings_.max_boxes;
    for (const std::uint64_t most : {std::min(all, kFirstBoxes), all}) {
      for (std::size_t first = 0; first < kWays; ++first) {
        settings_.max_boxes = most;
        Attempt attempt = by_opposite_axes(first);
        const bool is_last = attempt.obstacle.empty() ||
                             attempt.stopped_by == Reason::kInterrupted ||
                             attempt.stopped_by == Reason::kTimeBudget;
        if (first == 0 || attempt.obstacle.empty() ||
            attempt.postures.size() > best.postures.size()) {
          best = std::move(attempt);
          solutions_.opposite = (first + kFollowing[0]) % kWays + 1;
        }
        if (is_last) return best;
      }
      if (auto counted = by_counting()) {
        solutions_.opposite = 0;
        return std::move(*counted);
      }
    }
    return best;
  }

  Attempt by_opposite_axes(std::size_t first) {
    auto [loop, end] = rotated_loop(chain_, target_, first);
    move_origins(loop, end);
    const Interval circle(-mid(kPi) - kOverlapOfTurn, mid(kPi) + kOverlapOfTurn);
    Problem problem;
    problem.outer.assign(kSearched.size(), circle);
    const RootQuestion question{
        problem, {0, 0, kSearched.size(), 0}, [&, &loop = loop, &end = end] {
          return std::make_unique<OppositeAxes>(loop, end);
        }};
    const RootList list = search_roots(question, std::vector<Interval>(kSearched.size(), kTurn),
                                       settings_, run_.progress);
    count(list);
    RootJudge judge(question);
    Attempt attempt;
    attempt.stopped_by = list.stopped_by;
    for (const std::vector<Interval>& box : list.open)
      attempt.open.push_back(all_joints(box, first));
    if (!list.is_complete) attempt.obstacle = obstacle_of(list, attempt.open);
    for (const Root& four : list.roots)
      if (!add_posture(attempt, four, judge, loop, end, first)) {
        attempt.open.push_back(all_joints(four.values, first));
        attempt.obstacle = "a solution of four joints is not shown to be a posture, or none";
      }
    return attempt;
  }

  /// Returns false if neither is shown.
  bool add_posture(Attempt& attempt, const Root& four, RootJudge& judge, const ArmChain& loop,
                   const LinkFrame& end, std::size_t first) const {
    OppositeAxes axes(loop, end);
    const std::vector<RootSystem::Box> boxes = {four.values};
    axes.evaluate(boxes, false);
    if (!contains_zero(axes.at(0)->also.front())) return true;  // the other hand
    std::vector<double> near(kJoints), searched;
    for (const Interval& value : four.values) searched.push_back(mid(value));
    const auto others = OppositeAxes::approx_others(loop, end, searched);
    for (std::size_t i = 0; i < kSearched.size(); ++i)
      near[(kSearched[i] + first) % kJoints] = searched[i];
    for (std::size_t i = 0; i < kFollowing.size(); ++i)
      near[(kFollowing[i] + first) % kJoints] = others[i];
    auto root = judge_of_arm().root_near({}, near);
    if (!root || !is_posture(*root)) return false;
    // It is regular, so that no other values of the two joints fit the same four.
    std::vector<Interval> same;
    for (std::size_t i = 0; i < kSearched.size(); ++i) {
      const Interval& value = root->values[(kSearched[i] + first) % kJoints];
      const double whole = std::round((four.center[i] - mid(value)) / mid(kTurn));
      same.push_back(value + Interval(whole) * kTurn);
    }
    // The box of a root may be smaller than the enclosures: it is the only one much farther, too.
    const auto wide = four.is(same) ? std::nullopt : judge.root_near({}, four.center);
    if (!four.is(same) && !(wide && wide->is(four.values) && wide->is(same))) return false;
    attempt.postures.push_back(std::move(*root));
    return true;
  }

  Attempt by_all_joints() {
    Problem problem;
    std::vector<Interval> periods;
    for (std::size_t k = 0; k < kJoints; ++k) {
      const std::size_t i = free_[k];
      periods.push_back(turns(i) ? kTurn : Interval(0.0));
      if (!turns(i) && model_.limits.empty())
        throw UsageError("where joints slide, give each joint of the arm a range");
      problem.outer.push_back(turns(i)
                                  ? Interval(-mid(kPi) - kOverlapOfTurn, mid(kPi) + kOverlapOfTurn)
                                  : limits_of(i));
    }
    const RootList list =
        search_roots({problem,
                      {0, 0, kJoints, 0},
                      [this] { return std::make_unique<WholeArm>(chain_, target_); }},
                     periods, settings_, run_.progress);
    count(list);
    Attempt attempt;
    attempt.stopped_by = list.stopped_by;
    attempt.open = list.open;
    if (!list.is_complete) attempt.obstacle = obstacle_of(list, attempt.open);
    for (const Root& root : list.roots) {
      if (is_posture(root)) {
        attempt.postures.push_back(root);
        continue;
      }
      WholeArm arm(chain_, target_);
      const std::vector<RootSystem::Box> boxes = {root.values};
      arm.evaluate(boxes, false);
      if (!contains_zero(arm.at(0)->also.front())) continue;  // a half turn
      attempt.obstacle = "a solution is not told from a half turn";
      attempt.open.push_back(root.values);
    }
    return attempt;
  }

  void count(const RootList& list) {
    solutions_.boxes += list.boxes;
    solutions_.seconds += list.seconds;
    settings_.time_limit -= list.seconds;
  }

  /// `open`: of all joints; those that are not searched have a whole turn.
  [[nodiscard]] std::string obstacle_of(const RootList& list,
                                        const std::vector<std::vector<Interval>>& open) const {
    if (list.stopped_by) return describe(*list.stopped_by);
    std::string place;
    for (std::size_t k = 0; k < kJoints && !open.empty(); ++k)
      if (const Interval& value = open.front()[k]; width_ru(value) < 1)
        place += fmt::format("{}{} = {:.6g}{}", place.empty() ? ", near " : ", ",
                             solutions_.unknowns[k].name, mid(in_unit(k, value)),
                             unit_suffix(solutions_.unknowns[k].unit));
    return (varies() ? "within the tolerances postures may meet"
                     : "several postures meet, or there are infinitely many") +
           place;
  }

  /// A box of four joints as one of all six.
  [[nodiscard]] static std::vector<Interval> all_joints(const std::vector<Interval>& four,
                                                        std::size_t first) {
    std::vector<Interval> all(kJoints, Interval(-kPi.hi, kPi.hi));
    for (std::size_t i = 0; i < kSearched.size(); ++i)
      all[(kSearched[i] + first) % kJoints] = four[i];
    return all;
  }

  /// In radians.
  [[nodiscard]] Interval limits_of(std::size_t joint) const {
    const GiNaC::ex unit = in_degrees(joint) ? one_degree() : GiNaC::ex(1);
    const Range& range = model_.limits[joint];
    return hull(enclose_constant(range.lo * unit, "range"),
                enclose_constant(range.hi * unit, "range"));
  }

  void add(const Root& root) {
    CertainSolution solution{{}, 0, root.sign};
    if (!model_.limits.empty()) solution.limits = WithinLimits::kWithin;
    for (std::size_t k = 0; k < kJoints; ++k) {
      const std::size_t i = free_[k];
      Interval value = root.values[k];
      if (turns(i)) value -= Interval(std::round(mid(value) / mid(kTurn))) * kTurn;
      if (!model_.limits.empty()) note_limits(solution, i, value);
      solution.values.push_back(in_unit(k, value));
    }
    const std::vector<Interval> J = jacobian_at(chain_, posture_at(chain_, root.values));
    std::vector<double> matrix;
    for (const Interval& entry : J) matrix.push_back(mid(entry));
    solution.condition = approx_condition(matrix, kJoints);
    solutions_.found.push_back(std::move(solution));
  }

  void note_limits(CertainSolution& solution, std::size_t joint, const Interval& value) const {
    const Interval limits = limits_of(joint);
    bool is_within = false, may_be = false;
    const double turns_to_try = turns(joint) ? std::ceil(mag(limits) / mid(kTurn)) + 1 : 0;
    for (double turn = -turns_to_try; turn <= turns_to_try; ++turn) {
      const Interval moved = value + Interval(turn) * kTurn;
      is_within = is_within || certain_subset(moved, limits);
      may_be = may_be || !certain_disjoint(moved, limits);
    }
    if (is_within) return;
    if (may_be) {
      if (solution.limits == WithinLimits::kWithin) solution.limits = WithinLimits::kUnknown;
      return;
    }
    solution.limits = WithinLimits::kBeyond;
    solution.beyond += fmt::format("{}{} is beyond its limits", solution.beyond.empty() ? "" : ", ",
                                   model_.pose[joint].name);
  }

  const Model& model_;
  const SolveRun& run_;
  const ArmGeometry geometry_;
  ArmChain chain_;
  LinkFrame target_;
  std::vector<std::size_t> free_;  ///< by joint of the chain: its number in the pose
  const Problem problem_{};
  RootSettings settings_;
  Solutions solutions_;
  bool is_counted_ = false;
};

}  // namespace

Solutions solve_arm(const Request& request, const SolveRun& run) {
  return ArmSolver(request, run).solve();
}

}  // namespace regulus
