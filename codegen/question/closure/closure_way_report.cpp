// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/closure_way_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <span>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/place_text.hpp"
#include "codegen/answer/report/plain_words.hpp"
#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/report.hpp"
#include "codegen/answer/report/search_facts.hpp"
#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "codegen/question/closure/closure_claims.hpp"
#include "codegen/question/margin/margin_report.hpp"
#include "codegen/question/way/trajectory_margin.hpp"
#include "codegen/question/way/trajectory_report.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

/// `set`: the segments that are meant.
std::string words_of_poses(const PreparedWay& prepared, const std::string& set,
                           const char* around_set) {
  const Motion& motion = prepared.request.motion;
  const bool has_errors =
      std::ranges::any_of(motion.error, [](const GiNaC::ex& e) { return !e.is_zero(); });
  const bool is_uncertain = uncertain_count(geometry_along_way(prepared.request)) > 0;
  return fmt::format("every {}pose{} of the {}{}{}",
                     motion.where == Where::kEverywhere ? "" : "reachable ",
                     motion.constraints.empty() ? "" : " that the constraints allow", set,
                     has_errors ? around_set : "",
                     is_uncertain ? " and every value of the uncertain quantities" : "");
}

/// Returns why neither is shown, or the reason of the verdict.
std::string reason_of(const WayFinding& found) {
  if (found.result.verdict != Verdict::kPossibleProblem) return describe(found.result.reason);
  if (found.deciding && !found.is_refuted()) return found.deciding->obstacle;
  return found.threshold ? found.threshold->reason : describe(found.result.reason);
}

void tell_begin(const PreparedWay& prepared, const WayFinding& found, Facts& facts) {
  const Model& model = prepared.request.model;
  std::vector<StartCoordinate> place;
  for (std::size_t i = 0; i < model.pose.size(); ++i)
    place.push_back({model.pose[i].name, model.pose[i].unit,
                     enclose_constant(model.closure->start_pose[i], model.pose[i].name)});
  const bool is_known = !found.pieces.empty();
  tell_start(prepared.common, place,
             is_known ? found.pieces.front().links.configuration : std::vector<Interval>{}, facts);
  std::size_t links = 0;
  for (const ClosureResult& piece : found.pieces) links += piece.links.links;
  facts.add("links", links);
}

/// The segment that decides, with the place on it.
void tell_segment(const PreparedWay& prepared, const WayFinding& found, Facts& facts) {
  const Trajectory& trajectory = *prepared.request.motion.trajectory;
  if (found.threshold && found.threshold->below && !found.is_refuted()) {
    const PlaceBelow& below = *found.threshold->below;
    facts.add("segment", json_segment(trajectory, below.piece, below.place[0]));
    facts.add("folds", Json::array());
    return;
  }
  if (!found.deciding) {
    facts.add("segment", nullptr).add("folds", Json::array());
    return;
  }
  const PieceWithoutBranch& piece = *found.deciding;
  std::optional<Interval> s;
  if (piece.fold)
    s = piece.fold->place[0];
  else if (!found.result.blocking_box.empty())
    s = found.result.blocking_box[0];
  facts.tell("segment", json_segment(trajectory, piece.index, s),
             piece.is_refuted() ? "singular" : "blocked",
             describe_segment(trajectory, piece.index, s));
  if (piece.fold)
    tell_folds(*piece.alone, {*piece.fold}, facts);
  else
    facts.add("folds", Json::array());
}

/// Tells programs the whole question, and how it was searched.
void tell_work(const PreparedWay& prepared, const SearchOptions& search, const WayFinding& found,
               Facts& facts) {
  const PreparedSearch& p = prepared.common.preparation;
  const Statistics& statistics = found.result.statistics;
  facts.add("matrix", name(p.labels.matrix_kind));
  tell_threshold(p, facts);
  tell_method(p, search, found.result.method, statistics.boxes, facts);
  facts.add("boxes", statistics.boxes).add("max_frontier", statistics.max_frontier);
  facts.tell(
      "searched_alone", found.pieces.size(), "boxes",
      fmt::format("{} evaluated, at most {} waiting; {} of {} segments searched", statistics.boxes,
                  statistics.max_frontier, found.pieces.size(), prepared.pieces()));
  tell_time(p.seconds_spent(), facts);
  if (facts.are_for_programs()) add_search(search, json_question(prepared.request, search), facts);
}

void tell_question(const PreparedWay& prepared, const SearchOptions& search,
                   const WayFinding& found, Facts& facts) {
  facts.add("verdict", json_name(found.result.verdict)).add("reason", reason_of(found));
  tell_way_question(prepared, found, facts);
  tell_work(prepared, search, found, facts);
}

const char* word_of_claim(Claim claim) noexcept { return name(claim); }

}  // namespace

std::string words_of_segments(const PreparedWay& prepared) {
  return words_of_poses(
      prepared, counted(prepared.pieces(), "segment", "segments"),
      prepared.pieces() == 1 ? " and of the tube around it" : " and of the tube around them");
}

void tell_way_question(const PreparedWay& prepared, const WayFinding& found, Facts& facts) {
  tell_way(prepared.request, facts);
  say_uncertain_geometry(geometry_along_way(prepared.request), facts);
  tell_begin(prepared, found, facts);
}

std::string describe_claim(const PreparedWay& prepared, const WayFinding& found) {
  if (found.result.verdict == Verdict::kNoSingularity)
    return fmt::format("{}, for {}", describe_regular_branch(prepared.common),
                       words_of_segments(prepared));
  if (found.result.verdict == Verdict::kPossibleProblem) return nothing_proved(reason_of(found));
  const std::size_t piece =
      found.is_refuted() ? found.deciding->index : found.threshold->below->piece;
  return describe_refuted(prepared.common, fmt::format("segment {}", piece + 1),
                          found.is_refuted());
}

void tell_closure_way(const PreparedWay& prepared, const SearchOptions& search,
                      const WayFinding& found, Facts& facts) {
  tell_question(prepared, search, found, facts);
  facts.add("excluded", 0);
  tell_below(prepared.common, &prepared, found.threshold, facts);
  tell_segment(prepared, found, facts);
  tell_meaning(
      describe_meaning(prepared.common, found.result.verdict, found.is_refuted(), "these segments"),
      facts);
  const std::string claim = describe_claim(prepared, found);
  facts.tell("claim", claim, "claim", claim);
}

void tell_way_paving(const PreparedWay& prepared, const SearchOptions& search, double resolution,
                     const WayFinding& found, const std::vector<PathStretch>& stretches,
                     Facts& facts) {
  static constexpr std::array kClaimsOfBranch = {Claim::kFree, Claim::kUndecided, Claim::kOutside};
  static constexpr std::array kClaimsOfThreshold = {Claim::kFree, Claim::kSingular,
                                                    Claim::kUndecided, Claim::kOutside};
  tell_question(prepared, search, found, facts);
  const std::string poses = words_of_poses(prepared, "stretch", " and of the tube around it");
  facts.add("resolution", resolution);
  const std::span<const Claim> claims = found.threshold ? std::span<const Claim>(kClaimsOfThreshold)
                                                        : std::span<const Claim>(kClaimsOfBranch);
  tell_stretches(*prepared.request.motion.trajectory, stretches, claims, word_of_claim, facts);
  tell_segment(prepared, found, facts);
  const std::string free =
      fmt::format("free: {}, for {}", describe_regular_branch(prepared.common), poses);
  const std::string singular =
      found.threshold
          ? fmt::format("singular: {}, for {}", describe_threshold(prepared.common, false), poses)
          : "";
  facts.tell("claim", singular.empty() ? free : free + "; " + singular, "claim",
             singular.empty() ? free : free + '\n' + singular);
}

void tell_way_margin(const PreparedWay& prepared, const SearchOptions& search,
                     const WayFinding& found, const MarginQuestion& question, const Margin& margin,
                     double gap_wanted, Facts& facts) {
  tell_growing_way(prepared.request, question, facts);
  tell_begin(prepared, found, facts);
  tell_work(prepared, search, found, facts);
  facts.say("margin", fmt::format("{}: {} at {}", describe_range(question),
                                  counted(margin.boxes, "box", "boxes"),
                                  counted(margin.steps.size(), "value", "values")));
  add_bracket(question, margin, facts);
  for (const auto* step : {&margin.empty, &margin.certified, &margin.refuted})
    say_end(question, *step, facts);
  tell_below(prepared.common, &prepared, found.threshold, facts);
  tell_segment(prepared, found, facts);
  tell_gap(margin, gap_wanted, facts);
}

}  // namespace regulus::detail
