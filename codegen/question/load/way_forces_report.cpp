// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/report_parts.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "codegen/question/load/feasibility_report.hpp"
#include "codegen/question/load/way_forces.hpp"
#include "codegen/question/way/trajectory_report.hpp"

namespace regulus {
namespace {

using Json = nlohmann::ordered_json;

const Trajectory& trajectory_of(const WayForces& found) { return *found.request.motion.trajectory; }

/// Returns s of the witness, or of the box that blocks; nullopt if neither is known.
std::optional<Interval> parameter_of(const DecidingForces& deciding) {
  if (deciding.result.witness) return deciding.result.witness->variables.front();
  if (!deciding.result.blocking_box.empty()) return deciding.result.blocking_box.front();
  return std::nullopt;
}

std::string describe_claim_of_way(const WayForces& found) {
  const Motion& motion = found.request.motion;
  const bool is_uncertain = uncertain_count(found.hull.preparation) > 0;
  const bool has_errors =
      std::ranges::any_of(motion.error, [](const GiNaC::ex& e) { return !e.is_zero(); });
  return fmt::format("at every {}{} of the {} segments{}{}, forces {} hold every wrench of {}",
                     motion.where != Where::kEverywhere ? "reachable pose" : "pose",
                     motion.constraints.empty() ? "" : " that the constraints allow",
                     trajectory_of(found).pieces.size(),
                     has_errors ? " and of the tube around them" : "",
                     is_uncertain ? ", for every value of the uncertain quantities" : "",
                     describe_limits(found.hull), found.hull.load);
}

std::string reason_of(const WayForces& found) {
  if (found.deciding && found.deciding->prepared)
    return describe_reason(*found.deciding->prepared, found.deciding->result);
  return describe(found.reason);
}

std::string format_deciding(const WayForces& found) {
  if (!found.deciding) return "";
  const DecidingForces& d = *found.deciding;
  const bool is_infeasible = found.verdict == FeasibilityVerdict::kInfeasible;
  std::string text = fmt::format("{} {}\n", is_infeasible ? "at        " : "blocked by",
                                 describe_segment(trajectory_of(found), d.piece, parameter_of(d)));
  if (!d.prepared) return text;
  const PreparedSearch& p = d.prepared->preparation;
  if (d.result.witness)
    return text + fmt::format("           {}\n", describe_place(p, d.result.witness->variables)) +
           format_uncertain_values(p, d.result.witness->variables) +
           format_shortage(*d.prepared, *d.result.witness);
  if (!d.result.blocking_box.empty())
    text += fmt::format("           {}\n", describe_short_place(p, d.result.blocking_box));
  return text;
}

}  // namespace

std::string format_way_forces(const WayForces& found) {
  const PreparedForces& hull = found.hull;
  const std::size_t uncertain = uncertain_count(hull.preparation);
  std::string text = fmt::format("model      {}\nmotion     {}\n", found.request.model.name,
                                 found.request.motion.name) +
                     format_path(trajectory_of(found)) +
                     format_tube(found.request.model, found.request.motion);
  text += uncertain == 0 ? "uncertain  nothing: geometry is taken as exact\n"
                         : fmt::format("uncertain  {} {} of the geometry\n", uncertain,
                                       uncertain == 1 ? "quantity" : "quantities");
  text += fmt::format("load       {}, forces {}\n", hull.load, describe_limits(hull));
  text += fmt::format("boxes      {} evaluated; {} segment{} searched alone\n", found.boxes,
                      found.searched_alone, found.searched_alone == 1 ? "" : "s");
  text += format_time(found.seconds);
  if (found.verdict == FeasibilityVerdict::kFeasible) {
    if (found.excluded > 0)
      text += fmt::format("excluded   {} segment{} without a pose that the constraints allow\n",
                          found.excluded, found.excluded == 1 ? "" : "s");
    text += fmt::format("proved     {}\n", describe_claim_of_way(found));
  }
  if (found.verdict == FeasibilityVerdict::kPossibleProblem)
    text += fmt::format("reason     {}\n", reason_of(found));
  return text + format_deciding(found);
}

Json json_way_forces(const WayForces& found) {
  const bool undecided = found.verdict == FeasibilityVerdict::kPossibleProblem;
  const bool feasible = found.verdict == FeasibilityVerdict::kFeasible;
  const std::optional<DecidingForces>& d = found.deciding;
  Json report = {{"load", found.hull.load},
                 {"verdict", json_word(found.verdict)},
                 {"reason", undecided ? Json(reason_of(found)) : Json(nullptr)},
                 {"claim", feasible ? Json(describe_claim_of_way(found)) : Json(nullptr)},
                 {"forces", json_limits(found.hull)},
                 {"force_unit", found.hull.force_unit},
                 {"model", found.request.model.name},
                 {"model_file", found.request.model.path},
                 {"model_sha256", found.request.model.sha256},
                 {"motion", found.request.motion.name},
                 {"waypoints", json_waypoints(trajectory_of(found))}};
  const bool has_witness = d && d->prepared && d->result.witness;
  report["segment"] =
      d ? json_segment(trajectory_of(found), d->piece, parameter_of(*d)) : Json(nullptr);
  report["witness"] =
      has_witness ? json_witness_of(*d->prepared, *d->result.witness) : Json(nullptr);
  report["blocking_box"] = undecided && d && d->prepared && !d->result.blocking_box.empty()
                               ? json_parameters(d->prepared->preparation, d->result.blocking_box)
                               : Json(nullptr);
  report["nonempty"] = found.reason == Reason::kEmptyVariety ? Json(false) : Json(nullptr);
  report["excluded"] = found.excluded;
  report["searched_alone"] = found.searched_alone;
  report["boxes"] = found.boxes;
  report["stopped_by"] = nullptr;
  if (d && (!d->prepared || d->result.stopped_by))
    report["stopped_by"] = describe(d->prepared ? *d->result.stopped_by : found.reason);
  report["question"] = json_question(found.request, found.hull.search);
  report["seconds"] = json_seconds(found.seconds);
  return report;
}

}  // namespace regulus
