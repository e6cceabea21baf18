// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/closure_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/place_text.hpp"
#include "codegen/answer/report/plain_words.hpp"
#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/report.hpp"
#include "codegen/answer/report/search_facts.hpp"
#include "codegen/model/closure_start.hpp"
#include "codegen/model/degrees.hpp"
#include "codegen/question/closure/branch_threshold.hpp"
#include "codegen/question/closure/closure_claims.hpp"
#include "codegen/question/closure/paving_certificate.hpp"
#include "codegen/question/closure/steepest_corner.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

/// Ways to the end of the branch go to these parts of the first box that is not on it.
constexpr double kPartsOfBox[] = {0.5, 0.125};

std::string unknown_names(const Closure& closure) {
  std::string names;
  for (const PoseParameter& unknown : closure.unknowns)
    names += (names.empty() ? "" : ", ") + unknown.name;
  return names;
}

/// Returns "theta = 2.31381557986 rad (132.571867 deg)": the digits are certain.
std::string certain_words(const std::string& name, const Interval& value, const std::string& unit) {
  const double degrees = mid(value) * 180 / std::numbers::pi;
  return fmt::format("{} = {:.12g}{}{}", name, mid(value), unit_suffix(unit),
                     unit == "rad" ? fmt::format(" ({:.9g} deg)", degrees) : "");
}

Json json_fold(const PreparedClosure& prepared, const Fold& fold) {
  const Closure& closure = *prepared.request.model.closure;
  Json unknowns = Json::object(), direction = Json::object();
  for (std::size_t i = 0; i < closure.unknowns.size(); ++i) {
    unknowns[closure.unknowns[i].name] = json_interval(fold.unknowns[i]);
    direction[closure.unknowns[i].name] = json_interval(fold.direction[i]);
  }
  return {{"parameters", json_parameters(prepared.preparation, fold.place)},
          {"uncertain", json_uncertain(prepared.preparation, fold.place)},
          {"unknowns", std::move(unknowns)},
          {"direction", std::move(direction)},
          {"on_branch", fold.is_on_branch}};
}

void say_fold(const PreparedClosure& prepared, const Fold& fold, Facts& facts) {
  const Closure& closure = *prepared.request.model.closure;
  std::string at, moved;
  for (std::size_t k = 0; k < prepared.shape.parameters; ++k) {
    const MotionParameter& p = prepared.request.motion.parameters[k];
    at += (at.empty() ? "" : ", ") + certain_words(p.name, fold.place[k], p.unit);
  }
  for (std::size_t i = 0; i < closure.unknowns.size(); ++i) {
    const PoseParameter& unknown = closure.unknowns[i];
    at += (at.empty() ? "" : ", ") + certain_words(unknown.name, fold.unknowns[i], unknown.unit);
    moved += fmt::format("{}{} : {:.4g}", moved.empty() ? "" : ", ", unknown.name,
                         mid(fold.direction[i]));
  }
  facts.say(fold.is_on_branch ? "ends at" : "singular", at);
  if (const auto values = describe_uncertain_values(prepared.preparation, fold.place);
      !values.empty())
    facts.say("", values);
  facts.say("", fmt::format("with the motors locked nothing resists a motion in the ratio {}{}",
                            moved, fold.is_on_branch ? "" : "; not shown to be on the branch"));
}

/// The options with the time that is left. A limit that is over leaves the least time.
SearchOptions within(SearchOptions search, const Deadline& deadline) {
  if (search.time_limit != 0) search.time_limit = std::fmax(deadline.left(), 1e-9);
  return search;
}

/// The place at which the line from the start through a place leaves the ranges.
std::vector<double> at_the_border(const PreparedClosure& prepared, std::vector<double> place) {
  const std::vector<double>& from = prepared.near_start.variables;
  double part = kInfinity;
  for (std::size_t k = 0; k < place.size(); ++k) {
    const Interval& range = prepared.problem.outer[k];
    const double way = place[k] - from[k];
    if (way != 0) part = std::fmin(part, ((way > 0 ? range.hi : range.lo) - from[k]) / way);
  }
  for (std::size_t k = 0; k < place.size(); ++k) {
    const Interval range = prepared.problem.inner[k].value_or(prepared.problem.outer[k]);
    if (part < kInfinity)
      place[k] = std::clamp(from[k] + part * (place[k] - from[k]), range.lo, range.hi);
  }
  return place;
}

/// Returns places beyond the boxes that are on the branch, to either side of the start, of a motion of one
/// parameter: one a little beyond the first box that is not, then others within it, and then the end of the
/// range.
std::vector<std::vector<double>> beyond_the_branch(const PreparedClosure& prepared,
                                                   const ClosureResult& searched) {
  std::vector<std::pair<Interval, bool>> boxes;
  const std::vector<BranchLeaf>& leaves = searched.branch.tree.leaves();
  for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf)
    boxes.emplace_back(leaves[leaf].at.box[0],
                       leaf < searched.links.on_branch.size() && searched.links.on_branch[leaf]);
  std::ranges::sort(boxes, {}, [](const auto& box) { return box.first.lo; });
  const double start = prepared.near_start.variables[0];
  const Interval& range = prepared.problem.outer[0];
  std::vector<std::vector<double>> sides;
  const auto go = [&](double near, double end) {
    std::vector<double>& places = sides.emplace_back();
    places.push_back(std::clamp(end + kPartBeyondBoxes * (end - start), range.lo, range.hi));
    const double from = end > start ? std::fmax(near, start) : std::fmin(near, start);
    for (const double part : kPartsOfBox) places.push_back(from + part * (end - from));
    places.push_back(end > start ? range.hi : range.lo);
  };
  const auto below = std::find_if(boxes.rbegin(), boxes.rend(), [&](const auto& box) {
    return !box.second && box.first.lo < start;
  });
  if (below != boxes.rend()) go(below->first.hi, below->first.lo);
  const auto above = std::ranges::find_if(
      boxes, [&](const auto& box) { return !box.second && box.first.hi > start; });
  if (above != boxes.end()) go(above->first.lo, above->first.hi);
  return sides;
}

/// Returns the first singular configuration of the branch on the ways to these places; else one that is
/// not shown to be of the branch.
std::optional<Fold> first_fold(const PreparedClosure& prepared, const std::vector<double>& places,
                               const Deadline& deadline, const SearchOptions& search,
                               const FormingWatch& watch) {
  std::optional<Fold> found;
  for (const double end : places) {
    if (deadline.reason()) return found;
    auto fold = find_fold(prepared, {end}, {}, within(search, deadline), watch);
    if (fold && (!found || fold->is_on_branch)) found = std::move(fold);
    if (found && found->is_on_branch) return found;
  }
  return found;
}

void note(PreparedClosure& prepared, ClosureFinding& found, ThresholdFinding threshold) {
  prepared.preparation.seconds.search += threshold.seconds;
  found.threshold = std::move(threshold);
}

}  // namespace

std::string reason_of(const ClosureFinding& found) {
  if (found.searched.is_proved() && found.threshold) return found.threshold->reason;
  if (!found.searched.has_start) return found.searched.links.obstacle;
  if (found.searched.branch.is_empty) return describe(Reason::kEmptyVariety);
  if (!found.searched.branch.is_complete && found.searched.branch.reason == Reason::kWidth)
    return "a box at the minimum width has no certain branch: it may end there, be singular, or "
           "leave the "
           "range of an unknown";
  return found.searched.branch.is_complete ? found.searched.links.obstacle
                                           : describe(found.searched.branch.reason);
}

std::optional<Fold> fold_beyond(const PreparedClosure& prepared, std::vector<double> place,
                                bool is_lost, const SearchOptions& search,
                                const FormingWatch& watch) {
  if (place.empty()) {
    auto corner = steepest_corner(prepared);
    if (!corner) return std::nullopt;
    place = std::move(*corner), is_lost = true;
  }
  const auto parameters = place.begin() + std::ptrdiff_t(prepared.shape.parameters);
  std::vector<double> uncertain(parameters, place.end());
  place.erase(parameters, place.end());
  if (!is_lost) {
    // The middles of the uncertain quantities have the branch: perhaps not all have it.
    if (prepared.shape.variables == prepared.shape.parameters) return std::nullopt;
    place = at_the_border(prepared, place);
    auto corner = nearest_corner(prepared, place, search, watch);
    if (!corner) return std::nullopt;
    uncertain = std::move(*corner);
  }
  return find_fold(prepared, place, uncertain, search, watch);
}

ClosureFinding check_closure(PreparedClosure& prepared, const SearchOptions& search,
                             const FormingWatch& watch, const PiecesRun& run) {
  ClosureFinding found;
  BranchSettings settings = settings_of(prepared, search, watch.interrupt);
  const Deadline deadline(settings);
  settings.ask = [&](const std::vector<double>& place, bool is_lost) {
    if (auto fold = fold_beyond(prepared, place, is_lost, within(search, deadline), watch))
      found.folds = {std::move(*fold)};
    return found.is_refuted();
  };
  turn_to(search.workers, topic_of_branch(run.topic, prepared.request), prepared.request.motion);
  found.searched = run_closure(prepared, settings, run.progress, run.kept);
  if (has_threshold(prepared.request) && found.searched.is_proved()) {
    const BoxSearchSettings rest = rest_of(settings, deadline, found.searched.branch.boxes);
    note(prepared, found, compare_threshold(pieces_of(prepared, found.searched), rest, run));
  }
  return found;
}

ClosureFinding pave_closure(PreparedClosure& prepared, const SearchOptions& search,
                            double resolution, const FormingWatch& watch, const PiecesRun& run) {
  ClosureFinding found;
  BranchSettings settings = settings_of(prepared, search, watch.interrupt);
  settings.paves = true;
  settings.min_relative_width = resolution;
  const Deadline deadline(settings);
  turn_to(search.workers, topic_of_branch(run.topic, prepared.request), prepared.request.motion);
  found.searched = run_closure(prepared, settings, run.progress, run.kept);
  if (has_threshold(prepared.request)) {
    const BoxSearchSettings rest = rest_of(settings, deadline, found.searched.branch.boxes);
    note(prepared, found,
         pave_threshold(pieces_of(prepared, found.searched), resolution, rest, run));
  }
  if (prepared.shape.parameters != 1) return found;
  for (const std::vector<double>& side : beyond_the_branch(prepared, found.searched))
    if (auto fold = first_fold(prepared, side, deadline, search, watch))
      found.folds.push_back(std::move(*fold));
  return found;
}

void tell_boxes(const PreparedClosure& prepared, const ClosureFinding& found, Observer& observer) {
  const PavedTree paved = paved_trees({&found.searched, 1}, found.threshold).front();
  for (const Split& split : paved.tree->splits()) observer.on_split({split.parent, 0, {}}, split);
  Proof undecided;
  undecided.reason = Reason::kWidth;
  for (std::size_t i = 0; i < paved.words.size(); ++i) {
    const TreeBox& at = paved.tree->leaves()[i].at;
    const Claim claim = paved.claim_of(i);
    observer.on_leaf({at.id, at.depth, std::span(at.box).first(prepared.shape.variables)},
                     claim == Claim::kFree       ? Rule::kSecondOrder
                     : claim == Claim::kSingular ? Rule::kWitness
                     : claim == Claim::kOutside  ? Rule::kOutside
                                                 : Rule::kBlocked,
                     undecided);
  }
}

/// The configuration at the start: certified if it was found, else the values of the file.
void tell_start(const PreparedClosure& prepared, const std::vector<StartCoordinate>& place,
                const std::vector<Interval>& configuration, Facts& facts) {
  const Closure& closure = *prepared.request.model.closure;
  facts.say("closure",
            fmt::format("{} in {}",
                        counted(std::uint64_t(prepared.shape.unknowns), "equation", "equations"),
                        unknown_names(closure)));
  Json start = Json::object(), unknowns = Json::object();
  std::string at, values;
  for (const StartCoordinate& p : place) {
    start[p.name] = json_interval(p.value);
    at += fmt::format("{}{} = {:.9g}{}", at.empty() ? "" : ", ", p.name, mid(p.value),
                      unit_suffix(p.unit));
  }
  const bool is_certain = !configuration.empty();
  for (std::size_t i = 0; i < closure.unknowns.size(); ++i) {
    const Interval& value = is_certain ? configuration[i] : prepared.start.values[i];
    unknowns[closure.unknowns[i].name] = json_interval(value);
    values += fmt::format("{}{} = {:.9g}{}", values.empty() ? "" : ", ", closure.unknowns[i].name,
                          mid(value), unit_suffix(closure.unknowns[i].unit));
  }
  facts.tell(
      "branch",
      {{"start", std::move(start)}, {"unknowns", std::move(unknowns)}, {"certain", is_certain}},
      "branch",
      fmt::format("through {}{}{}{}", at, at.empty() ? "" : " with ", values,
                  is_certain ? "" : ", approximately"));
}

void tell_folds(const PreparedClosure& prepared, const std::vector<Fold>& found, Facts& facts) {
  Json folds = Json::array();
  for (const Fold& fold : found) {
    folds.push_back(json_fold(prepared, fold));
    say_fold(prepared, fold, facts);
  }
  facts.add("folds", std::move(folds));
}

void tell_branch(const PreparedClosure& prepared, const BranchLinks& links,
                 const std::vector<Fold>& folds, Facts& facts) {
  std::vector<StartCoordinate> place;
  for (std::size_t k = 0; k < prepared.shape.parameters; ++k) {
    const MotionParameter& p = prepared.request.motion.parameters[k];
    place.push_back({p.name, p.unit, prepared.start.place[k]});
  }
  tell_start(prepared, place, links.configuration, facts);
  facts.add("links", links.links);
  tell_folds(prepared, folds, facts);
}

Result check_result(const PreparedClosure& prepared, const ClosureFinding& found) {
  Result check;
  check.method = Method::kAuto;
  check.statistics.boxes = found.searched.branch.boxes;
  check.statistics.max_frontier = found.searched.branch.largest_open;
  check.statistics.seconds = prepared.preparation.seconds.search;
  check.stopped_by = found.searched.branch.stopped_by;
  for (const BranchLeaf& leaf : found.searched.branch.tree.leaves())
    ++check.statistics.leaves[std::size_t(leaf.tube         ? Rule::kSecondOrder
                                          : leaf.is_outside ? Rule::kOutside
                                                            : Rule::kBlocked)];
  check.reason =
      found.searched.branch.is_complete ? Reason::kAllBoxesCertified : found.searched.branch.reason;
  if (found.searched.branch.is_empty) check.reason = Reason::kEmptyVariety;
  if (found.searched.is_proved()) check.verdict = Verdict::kNoSingularity;
  if (found.is_refuted()) {
    check.verdict = Verdict::kSingularity;
    check.reason = Reason::kLostRank;
  }
  if (found.threshold) conclude(check, *found.threshold);
  if (check.verdict == Verdict::kPossibleProblem && !found.searched.branch.blocking_box.empty())
    check.blocking_box.assign(
        found.searched.branch.blocking_box.begin(),
        found.searched.branch.blocking_box.begin() + std::ptrdiff_t(prepared.shape.variables));
  check.occupancy = found.searched.branch.is_empty ? Occupancy::kEmpty
                    : is_start_in_motion(prepared.request.model, prepared.request.motion)
                        ? Occupancy::kInhabited
                        : Occupancy::kUnknown;
  return check;
}

void tell_closure(const PreparedClosure& prepared, const SearchOptions& search,
                  const ClosureFinding& found, Facts& facts) {
  const PreparedSearch& p = prepared.preparation;
  const Result check = check_result(prepared, found);
  facts.add("verdict", json_name(check.verdict));
  const bool is_decided = check.verdict != Verdict::kPossibleProblem;
  facts.add("reason", is_decided ? describe(check.reason) : reason_of(found));
  tell_question(p, prepared.request, facts);
  tell_branch(prepared, found.searched.links, found.folds, facts);
  if (facts.are_for_programs()) add_search(search, json_question(prepared.request, search), facts);
  tell_method(p, search, check.method, check.statistics.boxes, facts);
  facts.add("kernel", nullptr);
  facts.add("filters", Json::array());
  tell_boxes(check.statistics, facts);
  facts.add("leaves", json_leaves(check.statistics));
  tell_below(prepared, nullptr, found.threshold, facts);
  facts.add("blocking_box", nullptr);
  if (!check.blocking_box.empty()) {
    Json box = json_parameters(p, check.blocking_box);
    box.update(json_uncertain(p, check.blocking_box));
    facts.tell("blocking_box", std::move(box), "blocked", describe_place(p, check.blocking_box));
  }
  tell_occupancy(check, facts);
  tell_time(p.seconds_spent(), facts);
  tell_meaning(describe_meaning(prepared, check.verdict, found.is_refuted(), "this motion"), facts);
  const std::string claim = describe_claim(prepared, found);
  facts.tell("claim", claim, "claim", claim);
}

}  // namespace regulus::detail
