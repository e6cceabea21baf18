// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/branch_bound.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "codegen/answer/facts.hpp"
#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/place_text.hpp"
#include "codegen/answer/report/progress.hpp"
#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/exact/exact_double.hpp"
#include "codegen/model/exact/expression_parser.hpp"
#include "codegen/question/closure/closure_claims.hpp"
#include "codegen/question/quantity/negligible.hpp"
#include "codegen/question/way/trajectory_report.hpp"

namespace regulus::detail {
namespace {

/// The search ends with this part of the gap; the rest is room for the roundings of the verifier.
constexpr double kPartOfGap = 0.75, kRoomForVerifier = 0.1;
constexpr int kDigits = 8;  ///< of an end

AttainedPlace place_at(const PreparedClosure& prepared, std::span<const Interval> place,
                       std::span<const Interval> unknowns) {
  const PreparedSearch& p = prepared.preparation;
  const Closure& closure = *prepared.request.model.closure;
  AttainedPlace result;
  result.pose = describe_place(p, place);
  nlohmann::ordered_json values = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < closure.unknowns.size(); ++i)
    values[closure.unknowns[i].name] = json_interval(unknowns[i]);
  result.values = Facts(Readers::kPeople)
                      .say("", describe_configuration(prepared, unknowns))
                      .say("", describe_uncertain_values(p, place))
                      .text();
  result.json = {{"parameters", json_parameters(p, place)},
                 {"pose", nlohmann::ordered_json::object()},
                 {"uncertain", json_uncertain(p, place)},
                 {"unknowns", std::move(values)}};
  return result;
}

/// The same on a piece of a branch. `prepared`: the question about it.
AttainedPlace place_on(const BranchInPieces& branch, std::size_t piece,
                       const PreparedClosure& prepared, std::span<const Interval> place,
                       std::span<const Interval> unknowns) {
  AttainedPlace result = place_at(prepared, place, unknowns);
  if (const Trajectory* const way = branch.trajectory()) {
    result.pose = describe_segment(*way, piece, place[0]);
    result.values = Facts(Readers::kPeople).say("", branch.way().pose_at(piece, place[0])).text() +
                    result.values;
    result.json["pose"] = json_pose_on(branch.way(), piece, place[0], result.json["uncertain"]);
    result.json["segment"] = json_segment(*way, piece, place[0]);
  }
  return result;
}

SearchOptions limited(SearchOptions search, double seconds) {
  if (seconds < kInfinity) search.time_limit = TimeBudget::option(seconds);
  return search;
}

KeptPieces kept_as(BracketCheckpoint* checkpoint, std::string name) {
  return {checkpoint == nullptr ? nullptr : &checkpoint->file(), {}, std::move(name)};
}

/// One component over a branch that is proved.
class ComponentOverBranch {
 public:
  /// `topic`: of the searches.
  ComponentOverBranch(const BranchInPieces& branch, const Component& component,
                      const BoundSettings& settings, SearchTopic topic)
      : branch_(branch),
        settings_(settings),
        topic_(std::move(topic)),
        value_(branch.common().request.model, component),
        negligible_(component.kind == QuantityKind::kFiniteError
                        ? kNegligiblePart * widest_error()
                        : negligible(branch.common().request.model, component)) {
    result_.component = component;
    result_.proofs = proofs_of(component, settings);
  }

  static EndProofs proofs_of(const Component& component, const BoundSettings& settings) {
    const bool has_limit = settings.limit.has_value();
    return EndProofs(
        settings.certificate.empty() ? "" : settings.certificate + certificate_suffix(component),
        settings.placing, has_limit ? "the limit is exceeded" : kNoSafeProof,
        has_limit ? "no pose exceeds the limit" : kNoSingularProof);
  }

  ComponentBound run(const TimeBudget& budget) {
    search(budget);
    settings_.limit ? compare() : bracket();
    return std::move(result_);
  }

 private:
  void search(const TimeBudget& budget) {
    const BoxSearchSettings limits = settings_of(
        branch_.common(), limited(settings_.search, budget.left()), settings_.interrupt);
    SearchDisplay display(settings_.output);
    found_ = bracket_values(
        branch_.reached(), value_, aim(), limits,
        {display.observer(), topic_,
         kept_as(settings_.checkpoint, "values of " + settings_.part + result_.component.label)});
    result_.boxes = found_.boxes;
    result_.seconds.search = found_.seconds;
    if (!found_.place) return;
    result_.place = place_on(branch_, found_.piece, branch_.common(), found_.at,
                             enclose(*found_.place, found_.at));
  }

  [[nodiscard]] ValueAim aim() const {
    ValueAim aim{.gap = kPartOfGap * settings_.gap, .negligible = negligible_};
    if (!settings_.limit) return aim;
    const Interval limit = enclose_constant(*settings_.limit, "the limit");
    aim.below = value_.is_least() ? -limit.hi : limit.lo;
    aim.from = value_.is_least() ? -limit.lo : limit.hi;
    return aim;
  }

  /// Requires  a finite error, which the variables beyond those of the motion cause.
  [[nodiscard]] double widest_error() const {
    const std::vector<Interval>& ranges = branch_.common().problem.outer;
    double widest = 0;
    for (std::size_t k = branch_.common().shape.parameters; k < ranges.size(); ++k)
      widest = std::max(widest, width_ru(ranges[k]));
    return widest;
  }

  [[nodiscard]] double room_at(double f) const {
    return kRoomForVerifier * settings_.gap * std::fmax(std::fabs(f), negligible_);
  }

  /// That a magnitude attains 0 says nothing.
  void bracket() {
    const double attained = found_.attained - room_at(found_.attained),
                 upper = found_.upper + room_at(found_.upper);
    const bool is_known = std::isfinite(attained);
    const bool says_nothing =
        is_known && result_.component.is_absolute && !value_.is_least() && attained <= 0;
    if (is_known && !says_nothing)
      result_.attained =
          end_beyond(attained, value_.is_least() ? RoundTo::kAbove : RoundTo::kBelow);
    else
      result_.place.reset();
    if (says_nothing) result_.proofs.set_no_singular(kNothingAtZero);
    if (std::isfinite(upper))
      result_.proved = end_beyond(upper, value_.is_least() ? RoundTo::kBelow : RoundTo::kAbove);
    result_.is_closed = found_.is_closed;
    if (!found_.is_closed)
      result_.reason = found_.stopped_by
                           ? describe(*found_.stopped_by)
                           : "boxes at the least width are too wide for a narrower bracket";
    if (result_.proved) certify_safe(result_.proved->exact);
    if (result_.attained) certify_attained(result_.attained->exact);
  }

  /// A short decimal that claims no more.
  [[nodiscard]] BoundEnd end_beyond(double f, RoundTo side) const {
    const BoundEnd end = end_at(exact_number(value_.value_of(f)));
    return end_at(parse_constant(rounded_text(end, side, kDigits), {.file = "", .key = ""}).value);
  }

  void compare() {
    const ValueAim limit = aim();
    if (found_.attained >= *limit.from) {
      result_.verdict = LimitVerdict::kExceeded;
      certify_attained(*settings_.limit);
    } else if (found_.upper < *limit.below) {
      result_.verdict = LimitVerdict::kWithin;
      certify_safe(*settings_.limit);
    } else {
      result_.reason = found_.stopped_by ? describe(*found_.stopped_by)
                                         : "boxes at the least width are too wide to decide";
      result_.proofs.set_no_safe(kNothingClaimed);
      result_.proofs.set_no_singular(kNothingClaimed);
    }
  }

  void certify_safe(const GiNaC::ex& bound) {
    certify_value(result_.proofs, branch_.reached().proved(found_.trees), result_.component, bound,
                  std::nullopt);
  }
  void certify_attained(const GiNaC::ex& bound) {
    certify_value(result_.proofs, branch_.reached().proved(), result_.component, bound,
                  PlaceOfValue{found_.piece, found_.at});
  }

  const BranchInPieces& branch_;
  const BoundSettings& settings_;
  const SearchTopic topic_;
  const BranchValue value_;
  const double negligible_;
  BracketOfPieces found_;
  ComponentBound result_;
};

/// The branch is kept beside the values, for each set of derivatives.
const char* name_of_branch(DerivativesBy by) {
  return by == DerivativesBy::kVariablesAndPose      ? "branch and motors"
         : by == DerivativesBy::kVariablesAndNominal ? "branch and its copy"
                                                     : "branch";
}

/// Without a proof of the branch no value has a bound.
ComponentBound without_branch(const BranchInPieces& branch, const Component& component,
                              const BoundSettings& settings) {
  ComponentBound result;
  result.component = component;
  result.proofs = ComponentOverBranch::proofs_of(component, settings);
  result.is_empty = branch.is_empty();
  if (branch.end() == nullptr) {
    result.reason = branch.obstacle();
    return result;
  }
  const Fold& fold = *branch.end()->fold;
  result.reason = "the branch ends in the motion";
  // A is singular where the branch ends: its determinant and a singular value are 0, and its inverse
  // has no bound.
  const bool is_zero =
      component.kind == QuantityKind::kDeterminant || component.kind == QuantityKind::kSigmaMin;
  if (is_zero) result.attained = end_at(0);
  result.is_closed = !settings.limit && result.attains_zero();
  if (result.is_closed) result.reason.clear();
  const bool has_bound = is_zero || component.kind == QuantityKind::kDeterminantMax ||
                         component.kind == QuantityKind::kSigmaMax;
  result.is_unbounded = !settings.limit && !has_bound;
  // A finite error exceeds no limit there: the configuration has moved a finite way to the end.
  const bool exceeds_all = !has_bound && component.kind != QuantityKind::kFiniteError;
  if (settings.limit && (is_zero || exceeds_all)) result.verdict = LimitVerdict::kExceeded;
  if (has_bound && !is_zero) return result;
  result.place =
      place_on(branch, branch.end()->index, branch.question_of_end(), fold.place, fold.unknowns);
  if (!result.proofs.are_wanted()) return result;
  const ProofStatus written = branch.certify_end(result.proofs.singular_file(), settings.placing);
  if (written.is_lost())
    result.proofs.lose_singular(written.obstacle());
  else if (written.is_written())
    result.proofs.set_singular("the branch ends");
  else
    result.proofs.set_no_singular(written.obstacle());
  return result;
}

}  // namespace

SearchTopic BranchBounds::topic_of(const Component& component, const BoundSettings& settings,
                                   TopicKind kind) const {
  SearchTopic topic;
  topic.part = settings.part;
  topic.component = component.label;
  topic.kind = kind;
  topic.value = value_;
  return topic;
}

std::shared_ptr<BranchInPieces> BranchBounds::branch(const Request& request,
                                                     const Component& component, DerivativesBy by,
                                                     const BoundSettings& settings,
                                                     const TimeBudget& budget) {
  if (const auto known = branches_.find(by); known != branches_.end()) return known->second;
  FormingWatch watch;
  watch.interrupt = settings.interrupt;
  const SearchOptions search = limited(settings.search, std::fmax(budget.left(), budget.all() / 2));
  auto made = std::make_shared<BranchInPieces>(request, 0, search, watch, by);
  SearchDisplay display(settings.output);
  const TopicKind kind = by == DerivativesBy::kVariablesAndNominal ? TopicKind::kBranchWithNominal
                                                                   : TopicKind::kBranch;
  made->follow(search, watch,
               {display.observer(), topic_of(component, settings, kind),
                kept_as(settings.checkpoint, name_of_branch(by))});
  if (!made->stopped_by()) branches_.emplace(by, made);
  return made;
}

ComponentBound BranchBounds::bound(const Request& request, const Component& component,
                                   const BoundSettings& settings, const TimeBudget& budget) {
  const DerivativesBy by = BranchValue::needed(component.kind);
  std::uint64_t boxes = 0;
  StageSeconds seconds;
  const auto found = [&](DerivativesBy wanted) {
    const bool is_first = !branches_.contains(wanted);
    const auto branch = this->branch(request, component, wanted, settings, budget);
    if (is_first) {
      boxes += branch->boxes();
      seconds += branch->common().preparation.seconds_spent();
    }
    return branch;
  };
  // The mechanism alone, without its copy, tells if the branch ends.
  std::shared_ptr<BranchInPieces> branch;
  if (by == DerivativesBy::kVariablesAndNominal) branch = found(DerivativesBy::kVariables);
  if (!branch || branch->is_proved()) branch = found(by);
  ComponentBound result =
      branch->is_proved() ? ComponentOverBranch(*branch, component, settings,
                                                topic_of(component, settings, TopicKind::kQuestion))
                                .run(budget)
                          : without_branch(*branch, component, settings);
  result.boxes += boxes;
  result.seconds += seconds;
  return result;
}

BoundComponent bounds_over_branch() {
  return
      [bounds = std::make_shared<BranchBounds>()](
          const Request& request, const Component& component, const BoundSettings& settings,
          const TimeBudget& budget) { return bounds->bound(request, component, settings, budget); };
}

}  // namespace regulus::detail
