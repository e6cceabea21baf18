// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/arm_postures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/degrees.hpp"
#include "codegen/model/names.hpp"
#include "codegen/model/place.hpp"
#include "codegen/question/solve/arm_corner.hpp"
#include "codegen/question/solve/arm_following.hpp"
#include "codegen/question/solve/posture_search.hpp"
#include "codegen/question/solve/system_solutions.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/interval/floating_point_scope.hpp"

namespace regulus::detail {
namespace {

constexpr const char* kTheorem =
    "by the theorem that six joints that turn have at most 16 isolated complex postures (Primrose "
    "1986; Lee & Liang 1988; Raghavan & Roth 1993), of which 16 are certain";
const Interval kTurn = Interval(2.0) * kPi;

class ArmSolver {
 public:
  ArmSolver(const Request& request, const SolveRun& run)
      : request_(request),
        model_(request.model),
        run_(run),
        at_(arm_at_place(request, run.held)),
        unknowns_(at_.unknowns),
        slides_(slide_ranges(at_, request)) {
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
    const FloatingPointScope nearest(FloatingPointRounding::kNearest);
    if (at_.is_turned_away) return of_other_orientations();
    varies() ? find_within_tolerances() : take(find(at_, 0, PostureEffort::kAll));
    sort_by_values(solutions_.found);
    for (std::vector<Interval>& box : solutions_.open)
      for (std::size_t k = 0; k < box.size(); ++k) box[k] = in_unit(k, box[k]);
    if (solutions_.obstacle.empty()) solutions_.completeness = Completeness::kComplete;
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

  [[nodiscard]] bool varies() const { return at_.geometry != ArmGeometry::kNominal; }

  /// Searches with what is left of the limits.
  FoundPostures find(const ArmAtPlace& at, std::size_t number, PostureEffort effort) {
    FoundPostures found = PostureSearch(at, slides_, number, settings_, run_.progress).find(effort);
    count(found);
    return found;
  }

  /// `found`: by a search.
  template <class Found>
  void count(const Found& found) {
    solutions_.boxes += found.boxes;
    solutions_.seconds += found.seconds;
    solutions_.stopped_by = found.stopped_by;
    leave_rest(settings_, found);
  }

  /// The list is this one.
  void take(FoundPostures found) {
    solutions_.found.clear();
    for (const Root& root : found.postures) add(root, nullptr);
    solutions_.open = std::move(found.open);
    solutions_.obstacle = std::move(found.obstacle);
    if (found.may_meet) solutions_.obstacle += place_text(solutions_.open);
    solutions_.how =
        found.complex_found
            ? kTheorem
            : fmt::format("by a search of {}{}", boxes_text(solutions_.boxes), searched_ranges());
    solutions_.complex_found = found.complex_found;
    if (!found.complex_found) note_left_out(found.system);
  }

  void note_left_out(std::size_t system) {
    solutions_.opposite = 0;
    solutions_.left_out.reset();
    if (system == kWholeArm) return void(solutions_.left_out.emplace());
    const auto [a, b] = divided_unknowns(at_, system).following;
    if (at_.is_plain() && !at_.direction)
      solutions_.opposite = a % kOppositePairs + 1;
    else
      solutions_.left_out = {a + 1, b + 1};
  }

  /// Postures that one search does not tell apart are followed from those of the nominal arm.
  void find_within_tolerances() {
    FoundPostures at_once = find(at_, 0, PostureEffort::kFirst);
    const bool is_whole = at_once.obstacle.empty();
    const bool is_stopped = at_once.stopped_by && at_once.stopped_by != Reason::kBoxBudget;
    take(std::move(at_once));
    if (is_whole || is_stopped || settings_.max_boxes == 0) return;
    const ArmAtPlace nominal = nominal_arm_at_place(request_, run_.held);
    const FoundPostures all = find(nominal, kNominalArm, PostureEffort::kAll);
    if (all.obstacle.empty()) return follow(all);
    solutions_.obstacle = all.obstacle;
    if (all.may_meet)
      solutions_.obstacle = "of the nominal arm, " + all.obstacle + place_text(all.open);
  }

  void follow(const FoundPostures& all) {
    std::vector<std::vector<Interval>> postures;
    for (const Root& root : all.postures) postures.push_back(root.values);
    SolutionTubes tubes =
        follow_postures(at_, all.system, slides_, postures, settings_, run_.progress);
    count(tubes);
    solutions_.obstacle = why_left(tubes, all.postures.size());
    if (!tubes.are_all && !tubes.stopped_by) look_for_change(all, tubes);
    const auto followed =
        std::ranges::count_if(tubes.tubes, [](const auto& tube) { return tube.has_value(); });
    // The first search may have told more of them apart.
    if (!tubes.are_all && std::size_t(followed) < solutions_.found.size()) return;
    solutions_.found.clear();
    for (std::size_t i = 0; i < all.postures.size(); ++i)
      if (tubes.tubes[i]) add_followed(all.postures[i], *tubes.tubes[i]);
    note_left_out(all.system);
    solutions_.open = std::move(tubes.open);
    solutions_.how = fmt::format(
        "{} of the nominal arm, and by one of {} over all tolerances, none of which has a singular "
        "posture{}",
        all.complex_found ? kTheorem : fmt::format("by a search of {}", boxes_text(all.boxes)),
        boxes_text(tubes.boxes), searched_ranges());
  }

  /// Looks for numbers of the arm at which there are more or fewer postures.
  void look_for_change(const FoundPostures& all, const SolutionTubes& tubes) {
    constexpr int kMostTrials = 4;
    settings_.workers = nullptr;  // other processes have no such arm
    int trials = 0;
    for (std::size_t i = 0; i < all.postures.size() && trials < kMostTrials; ++i) {
      if (tubes.tubes[i]) continue;
      ++trials;
      const Model corner =
          model_towards_singular(request_, run_.held, middles_of(all.postures[i].values));
      const FoundPostures there =
          find(nominal_arm_at_place(request_, run_.held, corner), kNominalArm, PostureEffort::kAll);
      solutions_.stopped_by = tubes.stopped_by;  // a limit here is none of the list
      if (!there.obstacle.empty() || there.postures.size() == all.postures.size()) continue;
      solutions_.changes = true;
      solutions_.obstacle = fmt::format("the nominal arm has {}, and there are {} with {}",
                                        postures_text(all.postures.size()), there.postures.size(),
                                        uncertain_values_text(corner));
      return;
    }
  }

  static std::string postures_text(std::size_t count) {
    return count == 1 ? "1 posture" : fmt::format("{} postures", count);
  }

  static std::vector<double> middles_of(const std::vector<Interval>& values) {
    std::vector<double> middles;
    for (const Interval& value : values) middles.push_back(mid(value));
    return middles;
  }

  /// The tube that is found to first order is narrower, if it is found.
  void add_followed(const Root& posture, const std::vector<Interval>& tube) {
    const auto at_once = varying_posture_near(at_, middles_of(posture.values));
    add(posture, at_once ? &at_once->values : &tube);
  }

  [[nodiscard]] std::string why_left(const SolutionTubes& tubes, std::size_t count) const {
    if (tubes.are_all) return "";
    if (tubes.stopped_by) return describe(*tubes.stopped_by);
    return fmt::format(
        "the nominal arm has {}, and no other; within the tolerances some may meet{}",
        postures_text(count), place_text(tubes.open));
  }

  static std::string boxes_text(std::uint64_t boxes) {
    return fmt::format("{} box{}", in_thousands(boxes), boxes == 1 ? "" : "es");
  }

  /// ", near q1 = 0.3 rad": of the first of boxes in radians, without unknowns that were not searched.
  [[nodiscard]] std::string place_text(const std::vector<std::vector<Interval>>& open) const {
    std::string place;
    for (std::size_t k = 0; k < unknowns_.size() && !open.empty(); ++k)
      if (const Interval& value = open.front()[k]; width_ru(value) < 1)
        place += fmt::format("{}{} = {:.6g}{}", place.empty() ? ", near " : ", ",
                             solutions_.unknowns[k].name, mid(in_unit(k, value)),
                             unit_suffix(solutions_.unknowns[k].unit));
    return place;
  }

  /// In radians.
  [[nodiscard]] Interval limits_of(const ArmUnknown& unknown) const {
    const GiNaC::ex unit = in_degrees(unknown) ? one_degree() : GiNaC::ex(1);
    const Range& range = model_.limits[unknown.pose];
    return hull(enclose_constant(range.lo * unit, "range"),
                enclose_constant(range.hi * unit, "range"));
  }

  /// `tube`: where a posture of the nominal arm goes within the tolerances; null: `root` says it.
  void add(const Root& root, const std::vector<Interval>* tube) {
    CertainSolution solution{{}, 0, root.sign};
    if (!model_.limits.empty()) solution.limits = WithinLimits::kWithin;
    for (std::size_t k = 0; k < unknowns_.size(); ++k) {
      Interval value = tube != nullptr ? (*tube)[k] : root.values[k];
      if (unknowns_[k].is_periodic) value -= Interval(std::round(mid(value) / mid(kTurn))) * kTurn;
      value = value_of(k, value);
      if (!model_.limits.empty()) value = within_limits(solution, unknowns_[k], value);
      solution.values.push_back(in_unit(unknowns_[k], value));
    }
    solution.condition = condition_at(root);
    for (std::size_t k = 0; k < unknowns_.size() && varies(); ++k)
      solution.middle.push_back(mid(in_unit(k, root.values[k])));
    solutions_.found.push_back(std::move(solution));
  }

  [[nodiscard]] double condition_at(const Root& root) const {
    const std::size_t n = unknowns_.size();
    std::vector<Interval> J = jacobian_at(at_.chain, posture_at(at_.chain, root.values), n);
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

  const Request& request_;
  const Model& model_;
  const SolveRun& run_;
  const ArmAtPlace at_;
  const std::vector<ArmUnknown>& unknowns_;
  const std::map<std::size_t, SlideRange> slides_;  ///< by unknown
  RootSettings settings_;
  Solutions solutions_;
};

}  // namespace

Solutions solve_arm(const Request& request, const SolveRun& run) {
  return ArmSolver(request, run).solve();
}

}  // namespace regulus::detail
