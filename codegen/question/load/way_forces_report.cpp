// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/place_text.hpp"
#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/search_facts.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "codegen/question/load/feasibility_report.hpp"
#include "codegen/question/load/way_forces.hpp"
#include "codegen/question/way/trajectory_report.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

const Trajectory& trajectory_of(const WayForces& found) { return *found.request.motion.trajectory; }

/// Returns s of the witness, or of the box that blocks; nullopt if neither is known.
std::optional<Interval> parameter_of(const DecidingForces& deciding) {
  if (deciding.result.witness) return deciding.result.witness->variables.front();
  if (!deciding.result.blocking_box.empty()) return deciding.result.blocking_box.front();
  return std::nullopt;
}

/// Tells of the piece that decides: where, and why.
void tell_deciding(const WayForces& found, Facts& facts) {
  for (const char* key : {"segment", "witness", "blocking_box", "stopped_by"})
    facts.add(key, nullptr);
  if (!found.deciding) return;
  const DecidingForces& d = *found.deciding;
  const bool is_infeasible = found.verdict == FeasibilityVerdict::kInfeasible;
  facts.tell("segment", json_segment(trajectory_of(found), d.piece, parameter_of(d)),
             is_infeasible ? "at" : "blocked by",
             describe_segment(trajectory_of(found), d.piece, parameter_of(d)));
  if (!d.prepared || d.result.stopped_by)
    facts.add("stopped_by", describe(d.prepared ? *d.result.stopped_by : found.reason));
  if (!d.prepared) return;
  const PreparedSearch& p = d.prepared->preparation;
  if (d.result.witness) {
    facts.tell("witness", json_witness_of(*d.prepared, *d.result.witness), "",
               describe_place(p, d.result.witness->variables));
    facts.say("", describe_uncertain_values(p, d.result.witness->variables));
    say_shortage(*d.prepared, *d.result.witness, facts);
  } else if (!d.result.blocking_box.empty()) {
    facts.say("", describe_short_place(p, d.result.blocking_box));
  }
  if (found.verdict == FeasibilityVerdict::kPossibleProblem && !d.result.blocking_box.empty())
    facts.add("blocking_box", json_parameters(p, d.result.blocking_box));
}

/// Tells the claim, or why there is none.
void tell_claim(const WayForces& found, Facts& facts) {
  facts.add("claim", nullptr).add("reason", nullptr).add("excluded", found.excluded);
  if (found.verdict == FeasibilityVerdict::kFeasible) {
    if (found.excluded > 0)
      facts.say("excluded", fmt::format("{} segment{} without a pose that the constraints allow",
                                        found.excluded, found.excluded == 1 ? "" : "s"));
    const std::string claim = describe_claim(found);
    facts.tell("claim", claim, "proved", claim);
  }
  if (found.verdict == FeasibilityVerdict::kPossibleProblem)
    facts.tell("reason", describe_reason(found), "reason", describe_reason(found));
}

}  // namespace

std::string describe_claim(const WayForces& found) {
  const Motion& motion = found.request.motion;
  const bool is_uncertain = uncertain_count(found.hull.preparation) > 0;
  const bool has_errors =
      std::ranges::any_of(motion.error, [](const GiNaC::ex& e) { return !e.is_zero(); });
  const std::size_t pieces = trajectory_of(found).pieces.size();
  return fmt::format("at every {}{} of the {}{}{}, forces {} hold every wrench of {}",
                     motion.where != Where::kEverywhere ? "reachable pose" : "pose",
                     motion.constraints.empty() ? "" : " that the constraints allow",
                     counted(pieces, "segment", "segments"),
                     !has_errors   ? ""
                     : pieces == 1 ? " and of the tube around it"
                                   : " and of the tube around them",
                     is_uncertain ? ", for every value of the uncertain quantities" : "",
                     describe_limits(found.hull), found.hull.load);
}

std::string describe_reason(const WayForces& found) {
  if (found.deciding && found.deciding->prepared)
    return describe_reason(*found.deciding->prepared, found.deciding->result);
  return describe(found.reason);
}

void tell_way_forces(const WayForces& found, Facts& facts) {
  const PreparedForces& hull = found.hull;
  facts.add("verdict", json_word(found.verdict));
  tell_way(found.request, facts);
  say_uncertain_geometry(hull.preparation, facts);
  tell_load(hull, facts);
  facts.add("boxes", found.boxes);
  facts.tell("searched_alone", found.searched_alone, "boxes",
             fmt::format("{} evaluated; {} segment{} searched alone", found.boxes,
                         found.searched_alone, found.searched_alone == 1 ? "" : "s"));
  tell_time(found.seconds, facts);
  tell_claim(found, facts);
  facts.add("nonempty", found.reason == Reason::kEmptyVariety ? Json(false) : Json(nullptr));
  tell_deciding(found, facts);
  if (facts.are_for_programs())
    add_search(hull.search, json_question(found.request, hull.search), facts);
}

}  // namespace regulus::detail
