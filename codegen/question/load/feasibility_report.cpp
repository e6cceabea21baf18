// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/load/feasibility_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/paving_report.hpp"
#include "codegen/answer/report/place_text.hpp"
#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/search_facts.hpp"
#include "codegen/answer/report/vector_text.hpp"
#include "codegen/model/mechanism/twist.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormatVersion = 1;

std::vector<std::string> units_of_twist(const Model& model) {
  std::vector<std::string> units;
  for (const TwistComponent& c : twist_of(model)) units.push_back(c.unit);
  return units;
}

/// Returns the direction with a largest component of ±1, and the two numbers for it. It is that of a twist:
/// the numbers are of work.
std::string format_direction(const Model& model, const Shortage& s) {
  constexpr double kNoise = 1e-9;
  double most = 0;
  for (const double y : s.direction) most = std::fmax(most, std::fabs(y));
  std::vector<double> shown;
  for (const double y : s.direction) shown.push_back(std::fabs(y) > kNoise * most ? y / most : 0.0);
  const std::vector<std::string> units = units_of_twist(model);
  const std::string unit = unit_suffix(unit_of_work(model));
  return fmt::format("along {}, approximately, it needs {:.5g}{}, the forces give at most {:.5g}{}",
                     vector_text(shown, units), s.needed.lo / most, unit, s.possible.hi / most,
                     unit);
}

std::vector<double> middles(const std::vector<Interval>& values) {
  std::vector<double> result;
  for (const Interval& value : values) result.push_back(mid(value));
  return result;
}

Json json_limits(const LoadWords& words) {
  Json limits = Json::array();
  for (const Interval& limit : words.limits) limits.push_back(json_interval(limit));
  return limits;
}

std::string describe_uncertain(const PreparedSearch& p) {
  return uncertain_count(p) > 0 ? ", for every value of the uncertain quantities" : "";
}

const char* on_branch(const PreparedSearch& p) {
  return p.labels.is_branch ? "on the branch through the start, " : "";
}

void tell_witness(const PreparedForces& prepared, const FeasibilityResult& result, Facts& facts) {
  const PreparedSearch& p = prepared.preparation;
  facts.add("witness", nullptr);
  if (!result.witness) return;
  const ForceWitness& witness = *result.witness;
  facts.tell("witness", json_witness_of(prepared, witness), "at",
             describe_place(p, witness.variables));
  facts.say("", describe_uncertain_values(p, witness.variables));
  say_shortage(prepared, witness, facts);
}

void tell_reason(const PreparedForces& prepared, const FeasibilityResult& result, Facts& facts) {
  const PreparedSearch& p = prepared.preparation;
  facts.add("reason", nullptr).add("blocking_box", nullptr);
  if (result.verdict == FeasibilityVerdict::kPossibleProblem) {
    const std::string reason = describe_reason(prepared, result);
    facts.tell("reason", reason, "reason", reason);
    if (!result.blocking_box.empty())
      facts.tell("blocking_box", json_parameters(p, result.blocking_box), "blocked by",
                 describe_short_place(p, result.blocking_box));
  }
  facts.add("nonempty", result.is_empty       ? Json(false)
                        : result.is_inhabited ? Json(true)
                                              : Json(nullptr));
  if (result.verdict == FeasibilityVerdict::kFeasible && !result.is_inhabited)
    facts.say("warning", "no pose was found that certainly meets the constraints");
}

}  // namespace

Claim stand_in(ForceClaim claim) noexcept {
  switch (claim) {
    case ForceClaim::kFeasible:
      return Claim::kFree;
    case ForceClaim::kInfeasible:
      return Claim::kSingular;
    case ForceClaim::kUndecided:
      return Claim::kUndecided;
    case ForceClaim::kOutside:
      return Claim::kOutside;
  }
  return Claim::kUndecided;
}

const char* word_of_stand_in(Claim claim) noexcept {
  for (const ForceClaim held : kEveryForceClaim)
    if (stand_in(held) == claim) return name(held);
  return "none";
}

std::string describe_limits(const LoadWords& words) {
  const auto& limits = words.limits;
  const bool same = std::ranges::all_of(limits, [&](Interval x) { return x == limits.front(); });
  if (!same) return "within their limits";
  return fmt::format("within [{:.6g}, {:.6g}]{}", limits.front().lo, limits.front().hi,
                     unit_suffix(words.force_unit));
}

void say_shortage(const PreparedForces& prepared, const ForceWitness& witness, Facts& facts) {
  const Shortage& s = witness.shortage;
  const Model& model = prepared.request.model;
  facts.say("", fmt::format("{} has a wrench that no forces {} hold,\nnear the corner {}\n{}",
                            prepared.load, describe_limits(prepared),
                            vector_text(middles(prepared.forces.corners[s.corner]),
                                        units_of_wrench(model, twist_of(model))),
                            format_direction(model, s)));
}

void tell_load(const LoadWords& words, Facts& facts) {
  facts.tell("load", words.load, "load",
             fmt::format("{}, forces {}", words.load, describe_limits(words)));
  facts.add("forces", json_limits(words)).add("force_unit", words.force_unit);
}

std::string describe_claim(const LoadWords& words) {
  const PreparedSearch& p = words.preparation;
  return fmt::format("{}at every {}{}, forces {} hold every wrench of {}", on_branch(p),
                     describe_pose(p), describe_uncertain(p), describe_limits(words), words.load);
}

std::string describe_reason(const PreparedForces& prepared, const FeasibilityResult& result) {
  if (!result.is_continued)
    return fmt::format("the boxes of the checkpoint were not all judged again: {}",
                       describe(result.reason));
  if (result.reason == Reason::kUncertainty && uncertain_count(prepared.preparation) == 0)
    return "at one pose the forces are too near their limits, or the matrix is too near to losing "
           "rank";
  return describe(result.reason);
}

Json json_witness_of(const PreparedForces& prepared, const ForceWitness& witness) {
  const PreparedSearch& p = prepared.preparation;
  const Shortage& s = witness.shortage;
  const Model& model = prepared.request.model;
  Json corner = Json::array();
  for (const Interval& w : prepared.forces.corners[s.corner]) corner.push_back(json_interval(w));
  return {{"parameters", json_parameters(p, witness.variables)},
          {"uncertain", json_uncertain(p, witness.variables)},
          {"wrench", corner},
          {"wrench_units", units_of_wrench(model, twist_of(model))},
          {"direction", s.direction},
          {"direction_units", units_of_twist(model)},
          {"needed", json_interval(s.needed)},
          {"possible", json_interval(s.possible)},
          {"work_unit", unit_of_work(model)}};
}

const char* json_word(FeasibilityVerdict verdict) noexcept {
  switch (verdict) {
    case FeasibilityVerdict::kFeasible:
      return "feasible";
    case FeasibilityVerdict::kInfeasible:
      return "infeasible";
    case FeasibilityVerdict::kPossibleProblem:
      break;
  }
  return "possible-problem";
}

std::string describe_claim(const LoadWords& words, ForceClaim claim) {
  const PreparedSearch& p = words.preparation;
  switch (claim) {
    case ForceClaim::kFeasible:
      return fmt::format("{}at every pose of the box{}, forces {} hold every wrench of {}",
                         on_branch(p), describe_uncertain(p), describe_limits(words), words.load);
    case ForceClaim::kInfeasible:
      return fmt::format("{}at every pose of the box{}, {} has a wrench that no forces {} hold",
                         on_branch(p), describe_uncertain(p), words.load, describe_limits(words));
    case ForceClaim::kUndecided:
      return "neither was shown";
    case ForceClaim::kOutside:
      return "a constraint excludes every pose of the box";
  }
  return "";
}

void ForceVolumes::add(std::span<const Interval> box, ForceClaim claim) noexcept {
  volumes_.add(stand_in(claim), box);
}

const Share& ForceVolumes::of(ForceClaim claim) const noexcept {
  return volumes_.of(stand_in(claim));
}

std::string ForceVolumes::percentage(ForceClaim claim) const {
  return detail::percentage(volumes_, of(claim));
}

Interval ForceVolumes::fraction(ForceClaim claim) const noexcept {
  return volumes_.fraction(of(claim));
}

void tell_volumes(const LoadWords& words, const ForceVolumes& volumes, Facts& facts) {
  Json kinds = Json::object();
  for (const ForceClaim claim : kEveryForceClaim) {
    const std::uint64_t boxes = volumes.of(claim).boxes;
    kinds[name(claim)] = {{"boxes", boxes}, {"fraction", json_interval(volumes.fraction(claim))}};
    if (claim != ForceClaim::kOutside || words.preparation.labels.constraints > 0)
      facts.say(name(claim),
                fmt::format("{} in {}", volumes.percentage(claim), counted(boxes, "box", "boxes")));
  }
  facts.add("boxes_by_claim", std::move(kinds));
}

void tell_forces(const PreparedForces& prepared, const FeasibilityResult& result,
                 const ForceVolumes* volumes, Facts& facts) {
  const PreparedSearch& p = prepared.preparation;
  facts.add("verdict", json_word(result.verdict));
  tell_question(p, prepared.request, facts);
  tell_load(prepared, facts);
  if (volumes != nullptr) tell_volumes(prepared, *volumes, facts);
  facts.tell("boxes", result.boxes, "boxes", fmt::format("{} evaluated", result.boxes));
  tell_time(p.seconds_spent(), facts);
  facts.add("stopped_by", result.stopped_by ? Json(describe(*result.stopped_by)) : Json(nullptr));
  if (result.stopped_by && result.verdict != FeasibilityVerdict::kPossibleProblem)
    facts.say("stopped", describe(*result.stopped_by));
  facts.add("claim", nullptr);
  if (result.verdict == FeasibilityVerdict::kFeasible) {
    const std::string claim = describe_claim(prepared);
    facts.tell("claim", claim, "proved", claim);
  }
  tell_witness(prepared, result, facts);
  tell_reason(prepared, result, facts);
  if (facts.are_for_programs())
    add_search(prepared.search, json_question(p, prepared.search), facts);
}

Json json_forces_header(const LoadWords& words, double resolution) {
  const PreparedSearch& p = words.preparation;
  Json claims = Json::object();
  for (const ForceClaim claim : kEveryForceClaim)
    claims[name(claim)] = describe_claim(words, claim);
  return {{"regulus_forces", kFormatVersion},
          {"model", p.labels.model},
          {"model_sha256", p.labels.model_sha256},
          {"motion", p.labels.motion},
          {"load", words.load},
          {"forces", json_limits(words)},
          {"force_unit", words.force_unit},
          {"parameters", json_parameters(p, p.variety.outer)},
          {"uncertain", json_uncertain(p, p.variety.outer)},
          {"resolution", resolution},
          {"kinds", claims}};
}

Json json_forces_box(const LoadWords& words, std::span<const Interval> box, ForceClaim claim) {
  return {{"kind", name(claim)}, {"box", json_parameters(words.preparation, box)}};
}

}  // namespace regulus::detail
