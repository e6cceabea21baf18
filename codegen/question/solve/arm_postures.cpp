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
#include "codegen/question/solve/arm_place.hpp"
#include "codegen/question/solve/arm_slides.hpp"
#include "codegen/question/solve/arm_system.hpp"
#include "codegen/question/solve/arm_tubes.hpp"
#include "codegen/question/solve/platform_legs.hpp"
#include "codegen/question/solve/root_search.hpp"
#include "codegen/question/solve/system_solutions.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/interval/floating_point_scope.hpp"
#include "runtime/solutions/arm_postures.hpp"

namespace regulus::detail {
namespace {

constexpr const char* kTheorem =
    "by the theorem that six joints that turn have at most 16 isolated complex postures (Primrose "
    "1986; Lee & Liang 1988; Raghavan & Roth 1993), of which 16 are certain";
/// Each way to choose opposite joints gets so many boxes at first, and then all that are left.
constexpr std::uint64_t kFirstBoxes = 3000;
/// After a box that cannot be split: each way then only looks for more postures that are certain.
constexpr std::uint64_t kBoxesAfterProblem = 4000;
constexpr double kOverlapOfTurn = 0x1p-8;  ///< of the search over a turn, in radians
/// E is no half turn if 3 less its trace is below this.
constexpr double kHalfTurn = 4;
const Interval kTurn = Interval(2.0) * kPi;

class ArmSolver {
 public:
  ArmSolver(const Request& request, const SolveRun& run)
      : model_(request.model),
        run_(run),
        at_(arm_at_place(request, run.held)),
        geometry_(at_.geometry),
        chain_(at_.chain),
        target_(at_.target),
        unknowns_(at_.unknowns),
        slides_(slide_ranges(at_, request)),
        systems_(systems_without_two(at_)) {
    if (varies()) tubes_.emplace(request, run.held);
    for (const ArmUnknown& u : unknowns_)
      solutions_.unknowns.push_back({model_.pose[u.pose].name, model_.pose[u.pose].unit,
                                     !u.is_periodic  ? 0
                                     : in_degrees(u) ? 360 * u.scale
                                                     : mid(kTurn) * u.scale});
    for (const auto& [k, slide] : slides_)
      if (!slide.has_all) solutions_.unknowns[k].range = slide.range;
  }

  Solutions solve() {
    run_.begin();
    settings_ = root_settings_of(run_);
    settings_.boxes_after_problem = kBoxesAfterProblem;
    const FloatingPointScope nearest(FloatingPointRounding::kNearest);
    if (at_.is_turned_away) return of_other_orientations();
    Attempt best = systems_.empty() ? by_all_joints() : by_opposite_axes();
    for (Root& root : best.postures) add(root);
    sort_by_values(solutions_.found);
    for (std::vector<Interval>& box : best.open)
      for (std::size_t k = 0; k < box.size(); ++k) box[k] = in_unit(k, box[k]);
    solutions_.open = std::move(best.open);
    solutions_.completeness =
        best.obstacle.empty() ? Completeness::kComplete : Completeness::kIncomplete;
    solutions_.obstacle = std::move(best.obstacle);
    solutions_.stopped_by = best.stopped_by;
    solutions_.how = is_counted_
                         ? kTheorem
                         : fmt::format("by a search of {} box{}{}", in_thousands(solutions_.boxes),
                                       solutions_.boxes == 1 ? "" : "es", searched_ranges());
    return std::move(solutions_);
  }

 private:
  Solutions of_other_orientations() {
    solutions_.completeness = Completeness::kComplete;
    solutions_.left_out.emplace();
    solutions_.how =
        "as the arm turns about one direction alone, and the tool's orientation is another";
    return std::move(solutions_);
  }

  /// Says where joints that slide were looked for, if postures may be elsewhere.
  [[nodiscard]] std::string searched_ranges() const {
    std::string text;
    for (const auto& [k, slide] : slides_)
      if (!slide.has_all)
        text += fmt::format("{}{} in {}{}", text.empty() ? ", of those with " : ", ",
                            solutions_.unknowns[k].name, short_interval(in_unit(k, slide.range)),
                            unit_suffix(solutions_.unknowns[k].unit));
    return text;
  }

  struct Attempt {
    std::vector<Root> postures;  ///< of all six unknowns, in radians
    std::vector<std::vector<Interval>> open;
    std::string obstacle;  ///< empty: the list is whole
    std::optional<Reason> stopped_by{};
  };

  [[nodiscard]] bool in_degrees(const ArmUnknown& unknown) const {
    return unknown.turns && is_in_degrees(model_.pose[unknown.pose].unit);
  }

  /// Returns the value of the joint that is the unknown's, in the unit of the report.
  [[nodiscard]] Interval in_unit(std::size_t unknown, const Interval& value) const {
    return in_unit(unknowns_[unknown], value_of(unknown, value));
  }
  /// `joint`: its value in radians.
  [[nodiscard]] Interval in_unit(const ArmUnknown& unknown, const Interval& joint) const {
    return in_degrees(unknown) ? Interval(180.0) * joint / kPi : joint;
  }
  /// The same in radians.
  [[nodiscard]] Interval value_of(std::size_t unknown, const Interval& value) const {
    return Interval(unknowns_[unknown].scale) * value;
  }

  [[nodiscard]] bool varies() const { return geometry_ != ArmGeometry::kNominal; }

  /// The whole arm near a posture. Nothing of the question but its sizes is read.
  [[nodiscard]] RootJudge judge_of_arm() const {
    const auto arm = [this] { return at_.equations(varies()); };
    return RootJudge({problem_, {0, 0, unknowns_.size(), 0}, arm});
  }

  /// 3 less the trace of E.
  [[nodiscard]] Interval trace_gap(const Root& root) const {
    const auto arm = at_.equations(false);
    arm->evaluate(std::vector<RootSystem::Box>{root.values}, false);
    return arm->at(0)->also.front();
  }

  /// True if E at a solution of the equations is the unit matrix, and not a half turn.
  [[nodiscard]] bool is_posture(const Root& root) const { return trace_gap(root).hi < kHalfTurn; }

  /// All postures, if as many as the theorem allows are certain among complex numbers.
  std::optional<Attempt> by_counting() {
    if (varies() || at_.direction || !at_.is_plain() || !slides_.empty()) return std::nullopt;
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
      for (const std::size_t first : systems_) {
        settings_.max_boxes = most;
        Attempt attempt = by_opposite_axes(first);
        const bool is_last = attempt.obstacle.empty() ||
                             attempt.stopped_by == Reason::kInterrupted ||
                             attempt.stopped_by == Reason::kTimeBudget;
        if (first == systems_.front() || attempt.obstacle.empty() ||
            attempt.postures.size() > best.postures.size()) {
          best = std::move(attempt);
          note_left_out(first);
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

  void note_left_out(std::size_t system) {
    const auto [a, b] = divided_unknowns(at_, system).following;
    const bool is_usual = at_.is_plain() && !at_.direction;
    solutions_.opposite = is_usual ? a % kOppositePairs + 1 : 0;
    if (!is_usual) solutions_.left_out = {a + 1, b + 1};
  }

  Attempt by_opposite_axes(std::size_t first) {
    const RootSystems systems = systems_of_arm(at_, first);
    const auto [searched, following] = divided_unknowns(at_, first);
    const auto [problem, periods] = ranges_of(searched);
    const RootQuestion question = systems.question(problem);
    const RootList list = search_roots(question, periods, settings_, run_.progress);
    count(list);
    RootJudge judge(question);
    Attempt attempt;
    attempt.stopped_by = list.stopped_by;
    for (const std::vector<Interval>& box : list.open)
      attempt.open.push_back(all_unknowns(box, first));
    if (!list.is_complete) attempt.obstacle = obstacle_of(list, attempt.open);
    for (const Root& four : list.roots)
      if (!add_posture(attempt, four, judge, systems, first)) {
        attempt.open.push_back(all_unknowns(four.values, first));
        attempt.obstacle = "a solution of four joints is not shown to be a posture, or none";
      }
    return attempt;
  }

  /// Returns false if neither is shown.
  bool add_posture(Attempt& attempt, const Root& four, RootJudge& judge, const RootSystems& systems,
                   std::size_t first) const {
    const auto system = systems.system();
    const std::vector<RootSystem::Box> boxes = {four.values};
    system->evaluate(boxes, false);
    if (!std::ranges::all_of(system->at(0)->also, contains_zero)) return true;  // the other hand
    const auto [searched, following] = divided_unknowns(at_, first);
    std::vector<double> near(unknowns_.size()), values;
    for (const Interval& value : four.values) values.push_back(mid(value));
    const auto others = approx_following(at_, first, values);
    for (std::size_t i = 0; i < searched.size(); ++i) near[searched[i]] = values[i];
    for (std::size_t i = 0; i < following.size(); ++i) near[following[i]] = others[i];
    auto root = tubes_ ? tubes_->posture_near(near) : std::nullopt;
    if (!root) root = judge_of_arm().root_near({}, near);
    if (!root || !is_posture(*root)) return false;
    // It is regular, so that no other values of the two joints fit the same four.
    std::vector<Interval> same;
    for (std::size_t i = 0; i < searched.size(); ++i) {
      const Interval& value = root->values[searched[i]];
      const double whole = unknowns_[searched[i]].is_periodic
                               ? std::round((four.center[i] - mid(value)) / mid(kTurn))
                               : 0;
      same.push_back(value + Interval(whole) * kTurn);
    }
    // The box of a root may be smaller than the enclosures: it is the only one much farther, too.
    const auto wide = four.is(same) ? std::nullopt : judge.root_near({}, four.center);
    if (!four.is(same) && !(wide && wide->is(four.values) && wide->is(same))) return false;
    attempt.postures.push_back(std::move(*root));
    return true;
  }

  /// Returns the ranges in which these unknowns are searched, and their periods.
  [[nodiscard]] std::pair<Problem, std::vector<Interval>> ranges_of(
      std::span<const std::size_t> searched) const {
    const Interval circle(-mid(kPi) - kOverlapOfTurn, mid(kPi) + kOverlapOfTurn);
    std::pair<Problem, std::vector<Interval>> ranges;
    for (const std::size_t k : searched) {
      const bool is_periodic = unknowns_[k].is_periodic;
      ranges.first.outer.push_back(is_periodic ? circle : slides_.at(k).range);
      ranges.second.push_back(is_periodic ? kTurn : Interval(0.0));
    }
    return ranges;
  }

  Attempt by_all_joints() {
    std::vector<std::size_t> all(unknowns_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    solutions_.left_out.emplace();
    const auto [problem, periods] = ranges_of(all);
    const RootSystems systems = systems_of_arm(at_, kWholeArm);
    const RootList list =
        search_roots(systems.question(problem), periods, settings_, run_.progress);
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
      if (!contains_zero(trace_gap(root))) continue;  // a half turn
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
    for (std::size_t k = 0; k < unknowns_.size() && !open.empty(); ++k)
      if (const Interval& value = open.front()[k]; width_ru(value) < 1)
        place += fmt::format("{}{} = {:.6g}{}", place.empty() ? ", near " : ", ",
                             solutions_.unknowns[k].name, mid(in_unit(k, value)),
                             unit_suffix(solutions_.unknowns[k].unit));
    return (varies() ? "within the tolerances postures may meet"
                     : "several postures meet, or there are infinitely many") +
           place;
  }

  /// A box of four unknowns as one of all six.
  [[nodiscard]] std::vector<Interval> all_unknowns(const std::vector<Interval>& four,
                                                   std::size_t first) const {
    std::vector<Interval> all(unknowns_.size(), Interval(-kPi.hi, kPi.hi));
    for (const auto& [k, slide] : slides_) all[k] = slide.range;
    const auto searched = divided_unknowns(at_, first).searched;
    for (std::size_t i = 0; i < searched.size(); ++i) all[searched[i]] = four[i];
    return all;
  }

  /// In radians.
  [[nodiscard]] Interval limits_of(const ArmUnknown& unknown) const {
    const GiNaC::ex unit = in_degrees(unknown) ? one_degree() : GiNaC::ex(1);
    const Range& range = model_.limits[unknown.pose];
    return hull(enclose_constant(range.lo * unit, "range"),
                enclose_constant(range.hi * unit, "range"));
  }

  void add(const Root& root) {
    CertainSolution solution{{}, 0, root.sign};
    if (!model_.limits.empty()) solution.limits = WithinLimits::kWithin;
    for (std::size_t k = 0; k < unknowns_.size(); ++k) {
      Interval value = root.values[k];
      if (unknowns_[k].is_periodic) value -= Interval(std::round(mid(value) / mid(kTurn))) * kTurn;
      value = value_of(k, value);
      if (!model_.limits.empty()) value = within_limits(solution, unknowns_[k], value);
      solution.values.push_back(in_unit(unknowns_[k], value));
    }
    solution.condition = condition_at(root);
    solutions_.found.push_back(std::move(solution));
  }

  [[nodiscard]] double condition_at(const Root& root) const {
    const std::size_t n = unknowns_.size();
    std::vector<Interval> J = jacobian_at(chain_, posture_at(chain_, root.values), n);
    if (at_.direction) J = along(*at_.direction, J);
    std::vector<double> matrix;
    for (std::size_t e = 0; e < J.size(); ++e) matrix.push_back(mid(J[e]) / unknowns_[e % n].scale);
    return approx_condition(matrix, n);
  }

  /// Notes whether the value is within the limits of its joint, and returns it: whole turns on if it is
  /// within them only then.
  Interval within_limits(CertainSolution& solution, const ArmUnknown& unknown,
                         const Interval& value) const {
    const Interval limits = limits_of(unknown), period = Interval(unknown.scale) * kTurn;
    bool may_be = false;
    const double turns_to_try = unknown.is_periodic ? std::ceil(mag(limits) / mid(period)) + 1 : 0;
    for (double turns = 0; turns <= turns_to_try; ++turns)
      for (const double turn : {-turns, turns}) {
        const Interval moved = turn == 0 ? value : value + Interval(turn) * period;
        if (certain_subset(moved, limits)) return moved;
        may_be = may_be || !certain_disjoint(moved, limits);
      }
    if (may_be) {
      if (solution.limits == WithinLimits::kWithin) solution.limits = WithinLimits::kUnknown;
      return value;
    }
    solution.limits = WithinLimits::kBeyond;
    solution.beyond += fmt::format("{}{} is beyond its limits", solution.beyond.empty() ? "" : ", ",
                                   model_.pose[unknown.pose].name);
    return value;
  }

  const Model& model_;
  const SolveRun& run_;
  const ArmAtPlace at_;
  const ArmGeometry geometry_;
  const ArmChain& chain_;
  const LinkFrame& target_;
  const std::vector<ArmUnknown>& unknowns_;
  const std::map<std::size_t, SlideRange> slides_;  ///< by unknown
  const std::vector<std::size_t> systems_;          ///< without two unknowns
  std::optional<ArmTubes> tubes_{};
  const Problem problem_{};
  RootSettings settings_;
  Solutions solutions_;
  bool is_counted_ = false;
};

}  // namespace

Solutions solve_arm(const Request& request, const SolveRun& run) {
  return ArmSolver(request, run).solve();
}

}  // namespace regulus::detail
