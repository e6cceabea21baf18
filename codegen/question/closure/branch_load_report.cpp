// SPDX-License-Identifier: GPL-3.0-or-later
// Tells the question and the answer about a load over a branch.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/place_text.hpp"
#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/search_facts.hpp"
#include "codegen/answer/report/vector_text.hpp"
#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/closure_start.hpp"
#include "codegen/model/mechanism/twist.hpp"
#include "codegen/question/closure/branch_load.hpp"
#include "codegen/question/closure/closure_claims.hpp"
#include "codegen/question/closure/closure_way_report.hpp"
#include "codegen/question/way/trajectory_report.hpp"
#include "runtime/interval/floating_point_scope.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> units_of_unknowns(const PreparedBranchLoad& prepared) {
  std::vector<std::string> units;
  for (const PoseParameter& unknown : prepared.closure().request.model.closure->unknowns)
    units.push_back(unknown.unit);
  return units;
}

std::vector<std::string> units_of_load(const PreparedBranchLoad& prepared) {
  const Model& model = prepared.closure().request.model;
  return units_of_wrench(model, twist_of(model));
}

/// Encloses the wrench of the load for which the force is farthest: a corner of the ranges, and the point
/// of each ball in the direction of J's column, or against it.
std::vector<Interval> wrench_of(const PreparedBranchLoad& prepared, const ForceBeyond& beyond) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  std::vector<Interval> wrench;
  for (std::size_t i = 0; i < beyond.along.size(); ++i) {
    const GeometryParameter& entry = prepared.set().entries[i];
    const GiNaC::ex spread = entry.ball < 0 ? entry.tolerance : GiNaC::ex(0);
    const bool adds = (mid(beyond.along[i]) > 0) == beyond.is_above;
    wrench.push_back(
        enclose_constant(adds ? entry.value + spread : entry.value - spread, entry.name));
  }
  const Interval side(beyond.is_above ? 1.0 : -1.0);
  for (const ToleranceBall& ball : prepared.set().balls) {
    Interval squares(0.0);
    for (const std::size_t i : ball.members) squares += sqr(beyond.along[i]);
    const Interval length = sqrt(squares);
    if (!(length.lo > 0)) continue;  // then any point of the ball does
    const Interval reach = side * enclose_constant(ball.radius, "a radius") / length;
    for (const std::size_t i : ball.members) wrench[i] += reach * beyond.along[i];
  }
  return wrench;
}

/// The direction is that of the unknowns when the motor moves by 1, to the side of the limit. Along it
/// the work of the load is the force.
Json json_shortage(const PreparedBranchLoad& prepared, const BranchShortage& s) {
  const PreparedSearch& p = prepared.closure().preparation;
  const Model& model = prepared.closure().request.model;
  Json unknowns = Json::object(), wrench = Json::array(), direction = Json::array();
  for (std::size_t i = 0; i < s.unknowns.size(); ++i)
    unknowns[model.closure->unknowns[i].name] = json_interval(s.unknowns[i]);
  for (const Interval& w : wrench_of(prepared, s.beyond)) wrench.push_back(json_interval(w));
  const double side = s.beyond.is_above ? 1 : -1;
  for (const Interval& y : s.beyond.along) direction.push_back(side * mid(y));
  const Interval limit = prepared.limits[s.beyond.motor];
  return {{"parameters", json_parameters(p, s.place)},
          {"uncertain", json_uncertain(p, s.place)},
          {"unknowns", std::move(unknowns)},
          {"motor", model.pose[s.beyond.motor].name},
          {"wrench", std::move(wrench)},
          {"wrench_units", units_of_load(prepared)},
          {"direction", std::move(direction)},
          {"direction_units", units_of_unknowns(prepared)},
          {"needed", json_interval(Interval(side) * s.beyond.force)},
          {"possible", json_interval(Interval(s.beyond.is_above ? limit.hi : -limit.lo))},
          {"work_unit", prepared.force_unit}};
}

void say_shortage(const PreparedBranchLoad& prepared, const BranchShortage& s, Facts& facts) {
  const Model& model = prepared.closure().request.model;
  facts.say("", describe_configuration(prepared.closure(), s.unknowns));
  facts.say("", describe_uncertain_values(prepared.closure().preparation, s.place));
  if (s.beyond.along.empty()) return;
  std::vector<double> wrench;
  for (const Interval& w : wrench_of(prepared, s.beyond)) wrench.push_back(mid(w));
  const Interval limit = prepared.limits[s.beyond.motor];
  const std::string unit = unit_suffix(prepared.force_unit);
  facts.say("", fmt::format("{} has a wrench near {},\nfor which {} needs {:.6g}{}, with limits "
                            "[{:.6g}, {:.6g}]{}",
                            prepared.load, vector_text(wrench, units_of_load(prepared)),
                            model.pose[s.beyond.motor].name, mid(s.beyond.force), unit, limit.lo,
                            limit.hi, unit));
}

/// The segment with the place, or that on which the branch is not proved; then where the branch ends.
void tell_segment(const PreparedBranchLoad& prepared, const BranchLoadResult& result,
                  Facts& facts) {
  const Trajectory& way = *prepared.branch.trajectory();
  const auto& deciding = prepared.branch.found().deciding;
  facts.add("segment", nullptr).add("folds", Json::array());
  if (deciding && result.verdict != FeasibilityVerdict::kFeasible) {
    std::optional<Interval> s;
    if (deciding->fold) s = deciding->fold->place[0];
    facts.tell("segment", json_segment(way, deciding->index, s),
               deciding->is_refuted() ? "singular" : "blocked by",
               describe_segment(way, deciding->index, s));
    if (deciding->fold) tell_folds(*deciding->alone, {*deciding->fold}, facts);
  }
  if (result.shortage)
    facts.add("segment", json_segment(way, result.shortage->piece, result.shortage->place[0]));
}

void tell_shortage(const PreparedBranchLoad& prepared, const BranchLoadResult& result,
                   Facts& facts) {
  facts.add("witness", nullptr);
  if (prepared.branch.trajectory() != nullptr) tell_segment(prepared, result, facts);
  if (!result.shortage) return;
  const BranchShortage& shortage = *result.shortage;
  const Trajectory* const way = prepared.branch.trajectory();
  facts.tell("witness", json_shortage(prepared, shortage), "at",
             way == nullptr ? describe_place(prepared.closure().preparation, shortage.place)
                            : describe_segment(*way, shortage.piece, shortage.place[0]));
  if (way != nullptr)
    facts.say("", prepared.branch.way().pose_at(shortage.piece, shortage.place[0]));
  say_shortage(prepared, shortage, facts);
}

void tell_boxes(const PreparedBranchLoad& prepared, const BranchLoadResult& result, Facts& facts) {
  const std::string boxes = fmt::format("{} evaluated", result.boxes);
  facts.add("boxes", result.boxes);
  if (prepared.branch.trajectory() == nullptr) return static_cast<void>(facts.say("boxes", boxes));
  const std::size_t searched = prepared.branch.found().pieces.size();
  facts.add("excluded", 0)
      .tell(
          "searched_alone", searched, "boxes",
          fmt::format("{}; {} of {} segments searched", boxes, searched, prepared.branch.pieces()));
}

void tell_reason(const PreparedBranchLoad& prepared, const BranchLoadResult& result, Facts& facts) {
  facts.add("reason", nullptr).add("blocking_box", nullptr);
  const bool is_decided = result.verdict != FeasibilityVerdict::kPossibleProblem;
  if (!is_decided) facts.tell("reason", result.reason, "reason", result.reason);
  const std::vector<ClosureResult>& pieces = prepared.branch.found().pieces;
  std::vector<Interval> box =
      pieces.empty() ? std::vector<Interval>{} : pieces.back().branch.blocking_box;
  if (!box.empty()) box.resize(prepared.closure().shape.variables);
  if (!is_decided && !box.empty())
    facts.tell("blocking_box", json_parameters(prepared.closure().preparation, box), "blocked by",
               describe_short_place(prepared.closure().preparation, box));
  // A place of a witness has met the constraints.
  const Request& request = prepared.branch.way().request;
  const bool is_inhabited = result.shortage || is_start_in_motion(request.model, request.motion);
  facts.add("nonempty", result.is_empty ? Json(false) : is_inhabited ? Json(true) : Json(nullptr));
}

}  // namespace

std::string claim_of(const PreparedBranchLoad& prepared) {
  if (prepared.branch.trajectory() == nullptr) return describe_claim(prepared.words());
  return fmt::format("on the branch through the start, for {}, forces {} hold every wrench of {}",
                     words_of_segments(prepared.branch.way()), describe_limits(prepared.words()),
                     prepared.load);
}

void tell_branch_load(const PreparedBranchLoad& prepared, const BranchLoadResult& result,
                      const ForceVolumes* volumes, Facts& facts) {
  const PreparedSearch& p = prepared.closure().preparation;
  facts.add("verdict", json_word(result.verdict));
  if (prepared.branch.trajectory() != nullptr) {
    tell_way_question(prepared.branch.way(), prepared.branch.found(), facts);
  } else {
    tell_question(p, prepared.closure().request, facts);
    tell_branch(prepared.closure(), prepared.branch.found().pieces.front().links,
                prepared.branch.folds(), facts);
  }
  tell_load(prepared.words(), facts);
  if (volumes != nullptr) tell_volumes(prepared.words(), *volumes, facts);
  tell_boxes(prepared, result, facts);
  tell_time(p.seconds_spent(), facts);
  facts.add("stopped_by", result.stopped_by ? Json(describe(*result.stopped_by)) : Json(nullptr));
  if (result.stopped_by && result.verdict != FeasibilityVerdict::kPossibleProblem)
    facts.say("stopped", describe(*result.stopped_by));
  facts.add("claim", nullptr);
  if (result.verdict == FeasibilityVerdict::kFeasible) {
    const std::string claim = claim_of(prepared);
    facts.tell("claim", claim, "proved", claim);
  }
  tell_shortage(prepared, result, facts);
  tell_reason(prepared, result, facts);
  if (facts.are_for_programs())
    add_search(prepared.search, json_question(prepared.branch.way().request, prepared.search),
               facts);
}

}  // namespace regulus::detail
