// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/trajectory_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/place_text.hpp"
#include "codegen/answer/report/plain_words.hpp"
#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/report.hpp"
#include "codegen/answer/report/search_facts.hpp"
#include "codegen/answer/report/set_facts.hpp"
#include "codegen/answer/report/undefined_report.hpp"
#include "codegen/answer/report/witness_report.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "codegen/question/analysis/undefined.hpp"
#include "codegen/question/engine/choices.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

const Trajectory& trajectory_of(const TrajectoryCheck& check) {
  return *check.request.motion.trajectory;
}

double approx(const GiNaC::ex& rational) {
  return GiNaC::ex_to<GiNaC::numeric>(rational).to_double();
}

/// Approximate: for people; nullopt if the file has no times.
std::optional<double> time_of(const Trajectory& trajectory, const TrajectoryPiece& piece,
                              const std::optional<Interval>& s) {
  if (!s || !trajectory.has_time) return std::nullopt;
  const double begin = approx(piece.begin), end = approx(piece.end);
  return begin + mid(*s) * (end - begin);
}

std::string time_text(const Trajectory& trajectory, double time) {
  return fmt::format("t = {:.6g}{}", time, unit_suffix(trajectory.time_unit));
}

std::string lines_text(const TrajectoryPiece& piece) {
  return piece.first_line == piece.last_line
             ? fmt::format("line {}", piece.first_line)
             : fmt::format("lines {} and {}", piece.first_line, piece.last_line);
}

/// Returns the number of segments on which the constraints allow no pose.
std::size_t excluded_count(const TrajectoryCheck& check) {
  return static_cast<std::size_t>(
      std::ranges::count_if(check.path.leaves, &PieceLeaves::are_excluded));
}

void tell_excluded(const TrajectoryCheck& check, Facts& facts) {
  const std::size_t count = excluded_count(check);
  facts.add("excluded", count);
  if (count > 0 && check.verdict == Verdict::kNoSingularity)
    facts.say("excluded", fmt::format("{} segment{} without a {}: no part of the claim", count,
                                      count == 1 ? "" : "s", describe_poses_on_way(check)));
}

/// Returns "x ±0.1 cm, y ±0.1 cm": the control errors of the pose parameters from `begin` on, before
/// `end`; empty if there are none.
std::string describe_errors(const Request& request, std::size_t begin, std::size_t end) {
  const std::vector<GiNaC::ex>& errors = request.motion.error;
  std::string words;
  for (std::size_t i = begin; i < std::min(end, errors.size()); ++i)
    if (!errors[i].is_zero()) {
      const PoseParameter& p = request.model.pose[i];
      words += fmt::format("{}{} ±{:.6g}{}", words.empty() ? "" : ", ", p.name,
                           enclose_constant(errors[i], p.name).hi, unit_suffix(p.unit));
    }
  return words;
}

/// The number of pose parameters that the pieces give. Others are the errors of motors, which are
/// commanded to be 0.
std::size_t given_by_pieces(const Request& request) {
  return request.motion.trajectory->pieces.front().pose.size();
}

std::string describe_tube(const Request& request) {
  return describe_errors(request, 0, given_by_pieces(request));
}

/// The pose parameters of the way-points that keep one value all along the way.
void say_fixed(const Model& model, const Trajectory& t, Facts& facts) {
  if (!facts.are_for_people()) return;
  const auto is_zero = [](const GiNaC::ex& e) { return e.is_zero(); };
  for (std::size_t i = 0; i < t.pieces.front().pose.size(); ++i) {
    const GiNaC::ex& value = t.pieces.front().pose[i].power.front();
    const bool is_fixed = std::ranges::all_of(t.pieces, [&](const TrajectoryPiece& piece) {
      const PieceOfPose& p = piece.pose[i];
      return p.power.front().is_equal(value) && p.cosine.is_zero() && p.sine.is_zero() &&
             std::all_of(p.power.begin() + 1, p.power.end(), is_zero);
    });
    if (is_fixed) facts.say("", fixed_text(model.pose[i], value));
  }
}

std::string describe_path(const Trajectory& t) {
  const std::string count = fmt::format("{} segment{}, {}", t.pieces.size(),
                                        t.pieces.size() == 1 ? "" : "s", t.interpolation);
  if (!t.has_time) return fmt::format("{}, {}", count, t.file);
  return fmt::format("{}, t in [{:.6g}, {:.6g}]{}, {}", count, approx(t.pieces.front().begin),
                     approx(t.pieces.back().end), unit_suffix(t.time_unit), t.file);
}

}  // namespace

std::optional<Interval> parameter_of(const DecidingPiece& deciding) {
  const Result& result = deciding.result;
  if (result.witness) {
    const WitnessPoint& point =
        result.witness->near ? *result.witness->near : result.witness->points.front();
    return point.variables.front();
  }
  if (!result.blocking_box.empty()) return result.blocking_box.front();
  return std::nullopt;
}

std::string describe_poses_on_way(const TrajectoryCheck& check) {
  const Motion& motion = check.request.motion;
  const bool is_restricted = motion.where != Where::kEverywhere;
  return std::string(is_restricted ? "reachable pose" : "pose") +
         (motion.constraints.empty() ? "" : " that the constraints allow");
}

void tell_way(const Request& request, Facts& facts) {
  const Trajectory& t = *request.motion.trajectory;
  tell_model(request, facts);
  facts.tell("waypoints", json_waypoints(t), "path", describe_path(t)).add("notes", t.notes);
  say_fixed(request.model, t, facts);
  say_constraints(request.motion, facts);
  for (const std::string& note : t.notes) facts.say("note", note);
  facts.say("tube", describe_tube(request));
  facts.say("errors",
            describe_errors(request, given_by_pieces(request), request.model.pose.size()));
}

void say_uncertain_geometry(const SearchSubject& subject, Facts& facts) {
  if (uncertain_count(subject) > 0)
    say_uncertain(subject, facts);
  else
    facts.say("uncertain", "nothing: geometry is taken as exact");
}

SearchSubject geometry_along_way(const Request& request) {
  Request without_tube = request;
  for (GiNaC::ex& error : without_tube.motion.error) error = 0;
  return set_of(without_tube).subject;
}

std::string describe_request(const Request& request) {
  return text_of_facts([&](Facts& facts) {
    if (request.motion.trajectory) {
      tell_way(request, facts);
      say_uncertain_geometry(geometry_along_way(request), facts);
    } else {
      tell_model(request, facts);
      say_set(request, facts);
    }
  });
}

Json json_waypoints(const Trajectory& t) {
  return {{"file", t.file},
          {"sha256", t.sha256},
          {"interpolation", t.interpolation},
          {"segments", t.pieces.size()}};
}

std::string describe_segment(const Trajectory& trajectory, std::size_t piece,
                             const std::optional<Interval>& s) {
  const TrajectoryPiece& p = trajectory.pieces[piece];
  std::string text = fmt::format("segment {}", piece + 1);
  if (const auto time = time_of(trajectory, p, s)) text += ", " + time_text(trajectory, *time);
  return text + fmt::format(" ({}, {})", trajectory.file, lines_text(p));
}

Json json_segment(const Trajectory& trajectory, std::size_t piece,
                  const std::optional<Interval>& s) {
  const TrajectoryPiece& p = trajectory.pieces[piece];
  Json segment{{"segment", piece + 1}, {"lines", {p.first_line, p.last_line}}};
  if (const auto time = time_of(trajectory, p, s)) segment["time"] = *time;
  if (s) segment["s"] = json_interval(*s);
  return segment;
}

void tell_deciding_piece(const TrajectoryCheck& check, Facts& facts) {
  facts.add("segment", nullptr).add("witness", nullptr);
  if (!check.deciding) return;
  const DecidingPiece& d = *check.deciding;
  const Trajectory& t = trajectory_of(check);
  const std::optional<Interval> s = parameter_of(d);
  facts.tell("segment", json_segment(t, d.index, s),
             check.verdict == Verdict::kSingularity ? "singular" : "blocked",
             describe_segment(t, d.index, s));
  if (!d.preparation) return;
  tell_witness(*d.preparation, d.result, facts);
  if (d.result.blocking_box.empty()) return;
  facts.say("", describe_place(*d.preparation, d.result.blocking_box));
  if (d.result.reason == Reason::kUndefined)
    tell_undefined(*d.preparation, find_undefined(*d.preparation, d.result.blocking_box), facts);
}

std::string describe_trajectory_claim(const TrajectoryCheck& check) {
  const PreparedSearch& p = check.hull;
  const std::size_t pieces = trajectory_of(check).pieces.size();
  const char* const around =
      pieces == 1 ? " and of the tube around it" : " and of the tube around them";
  const std::string of_path =
      fmt::format("every {} of the {}", describe_poses_on_way(check),
                  counted(pieces, "segment", "segments")) +
      (describe_tube(check.request).empty() ? "" : around) +
      (uncertain_count(p) == 0 ? "" : " and every value of the uncertain quantities");
  const bool threshold = p.variety.alpha.hi > 0;
  if (check.verdict == Verdict::kNoSingularity)
    return threshold ? fmt::format("|det J⁻¹| > {} for {}", threshold_text(p.variety.alpha, true),
                                   of_path)
                     : fmt::format("the {} has full rank for {}", describe_size(p), of_path);
  if (check.verdict == Verdict::kSingularity)
    return claim(*check.deciding->preparation, check.deciding->result);
  return nothing_proved(describe(check.reason));
}

void tell_trajectory_question(const TrajectoryCheck& check, const SearchOptions& search,
                              Facts& facts) {
  tell_way(check.request, facts);
  say_uncertain_geometry(check.hull, facts);
  tell_trajectory_work(check, search, facts);
}

void tell_trajectory_work(const TrajectoryCheck& check, const SearchOptions& search, Facts& facts) {
  const PreparedSearch& p = check.hull;
  const Statistics& statistics = check.path.statistics;
  facts.add("matrix", name(p.labels.matrix_kind));
  tell_threshold(p, facts);
  SearchOptions used = search;
  used.engine = check.engine;
  tell_method(p, used, search.method, statistics.boxes, facts);
  facts.add("boxes", statistics.boxes).add("max_frontier", statistics.max_frontier);
  facts.tell("searched_alone", check.searched_alone, "boxes",
             fmt::format("{} evaluated, at most {} waiting; {} segment{} searched alone",
                         statistics.boxes, statistics.max_frontier, check.searched_alone,
                         check.searched_alone == 1 ? "" : "s"));
  tell_time(check.seconds, facts);
  if (!facts.are_for_programs()) return;
  add_search(search, json_question(check.request, search), facts);
  facts.add("engine", word_of(check.engine));
}

void tell_trajectory(const TrajectoryCheck& check, const SearchOptions& search, Facts& facts) {
  facts.add("verdict", json_name(check.verdict)).add("reason", describe(check.reason));
  tell_trajectory_question(check, search, facts);
  tell_excluded(check, facts);
  tell_deciding_piece(check, facts);
  tell_meaning(check.hull, check.verdict, check.reason, facts);
  const std::string claim = describe_trajectory_claim(check);
  facts.tell("claim", claim, "claim", claim);
}

}  // namespace regulus::detail
