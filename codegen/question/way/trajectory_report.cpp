// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/trajectory_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/report.hpp"
#include "codegen/answer/report/report_parts.hpp"
#include "codegen/answer/report/undefined_report.hpp"
#include "codegen/answer/report/witness_report.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "codegen/question/analysis/undefined.hpp"
#include "codegen/question/engine/choices.hpp"

namespace regulus {
namespace {

using Json = nlohmann::ordered_json;

const Trajectory& trajectory_of(const TrajectoryCheck& check) {
  return *check.request.motion.trajectory;
}

double approx(const GiNaC::ex& rational) {
  return GiNaC::ex_to<GiNaC::numeric>(rational).to_double();
}

/// Returns s of the witness, or of the box that blocks; nullopt if neither is known.
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

std::string format_uncertain_count(const TrajectoryCheck& check) {
  const std::size_t count = uncertain_count(check.hull);
  if (count == 0) return "uncertain  nothing: geometry is taken as exact\n";
  return fmt::format("uncertain  {} {} of the geometry: {}\n", count,
                     count == 1 ? "quantity" : "quantities", describe_groups(check.hull.labels));
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

/// "reachable pose that the constraints allow"
std::string describe_poses(const TrajectoryCheck& check) {
  const Motion& motion = check.request.motion;
  const bool is_restricted = motion.where != Where::kEverywhere;
  return std::string(is_restricted ? "reachable pose" : "pose") +
         (motion.constraints.empty() ? "" : " that the constraints allow");
}

std::string format_excluded(const TrajectoryCheck& check) {
  const std::size_t count = excluded_count(check);
  if (count == 0 || check.verdict != Verdict::kNoSingularity) return "";
  return fmt::format("excluded   {} segment{} without a {}: no part of the claim\n", count,
                     count == 1 ? "" : "s", describe_poses(check));
}

Json json_segment(const TrajectoryCheck& check) {
  if (!check.deciding) return nullptr;
  return json_segment(trajectory_of(check), check.deciding->index, parameter_of(*check.deciding));
}

}  // namespace

std::string format_path(const Trajectory& t) {
  std::string line = fmt::format("path       {} segment{}, {}", t.pieces.size(),
                                 t.pieces.size() == 1 ? "" : "s", t.interpolation);
  if (t.has_time)
    line += fmt::format(", t in [{:.6g}, {:.6g}]{}", approx(t.pieces.front().begin),
                        approx(t.pieces.back().end), unit_suffix(t.time_unit));
  line += fmt::format(", {}\n", t.file);
  for (const std::string& note : t.notes) line += fmt::format("note       {}\n", note);
  return line;
}

std::string format_tube(const Model& model, const Motion& motion) {
  std::string words;
  for (std::size_t i = 0; i < motion.error.size(); ++i)
    if (!motion.error[i].is_zero()) {
      const PoseParameter& p = model.pose[i];
      words += fmt::format("{}{} ±{:.6g}{}", words.empty() ? "" : ", ", p.name,
                           enclose_constant(motion.error[i], p.name).hi, unit_suffix(p.unit));
    }
  return words.empty() ? "" : fmt::format("tube       {}\n", words);
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

std::string format_deciding_piece(const TrajectoryCheck& check) {
  if (!check.deciding) return "";
  const DecidingPiece& d = *check.deciding;
  std::string text =
      fmt::format("{}{}\n", check.verdict == Verdict::kSingularity ? "singular   " : "blocked    ",
                  describe_segment(trajectory_of(check), d.index, parameter_of(d)));
  if (!d.preparation) return text;
  text += format_witness(*d.preparation, d.result);
  if (!d.result.blocking_box.empty())
    text += fmt::format("           {}\n", describe_place(*d.preparation, d.result.blocking_box));
  if (d.result.reason == Reason::kUndefined && !d.result.blocking_box.empty())
    text += format_undefined(*d.preparation, find_undefined(*d.preparation, d.result.blocking_box));
  return text;
}

std::string describe_trajectory_claim(const TrajectoryCheck& check) {
  const PreparedSearch& p = check.hull;
  const std::string of_path =
      fmt::format("every {} of the {} segment{}", describe_poses(check),
                  trajectory_of(check).pieces.size(),
                  trajectory_of(check).pieces.size() == 1 ? "" : "s") +
      (format_tube(check.request.model, check.request.motion).empty()
           ? ""
           : " and of the tube around them") +
      (uncertain_count(p) == 0 ? "" : " and every value of the uncertain quantities");
  const bool threshold = p.variety.alpha.hi > 0;
  if (check.verdict == Verdict::kNoSingularity)
    return threshold ? fmt::format("|det J⁻¹| > {} for {}", threshold_text(p.variety.alpha, true),
                                   of_path)
                     : fmt::format("the {} has full rank for {}", describe_size(p), of_path);
  if (check.verdict == Verdict::kSingularity)
    return claim(*check.deciding->preparation, check.deciding->result);
  return fmt::format("none about the {}: {}", describe_size(p), describe(check.reason));
}

std::string format_trajectory_question(const TrajectoryCheck& check, SearchOptions search) {
  search.engine = check.engine;
  const PreparedSearch& p = check.hull;
  const Statistics& statistics = check.path.statistics;
  std::string text =
      fmt::format("model      {}\nmotion     {}\n", p.labels.model, p.labels.motion) +
      format_path(trajectory_of(check)) + format_tube(check.request.model, check.request.motion) +
      format_uncertain_count(check) + format_method(p, search, search.method, statistics.boxes);
  text += fmt::format("boxes      {} evaluated, at most {} waiting; {} segment{} searched alone\n",
                      statistics.boxes, statistics.max_frontier, check.searched_alone,
                      check.searched_alone == 1 ? "" : "s");
  return text + format_time(check.seconds);
}

std::string format_trajectory(const TrajectoryCheck& check, const SearchOptions& search) {
  return format_trajectory_question(check, search) + format_excluded(check) +
         format_deciding_piece(check) +
         fmt::format("claim      {}\n", describe_trajectory_claim(check));
}

void add_trajectory_question(Json& report, const TrajectoryCheck& check,
                             const SearchOptions& search) {
  const PreparedSearch& p = check.hull;
  const Trajectory& t = trajectory_of(check);
  report["model"] = p.labels.model;
  report["model_file"] = p.model_file;
  report["model_sha256"] = p.labels.model_sha256;
  report["motion"] = p.labels.motion;
  report["waypoints"] = json_waypoints(t);
  report["notes"] = t.notes;
  report["matrix"] = name(p.labels.matrix_kind);
  report["alpha"] = mid(p.variety.alpha);
  report["method"] = name(search.method);
  report["boxes"] = check.path.statistics.boxes;
  report["max_frontier"] = check.path.statistics.max_frontier;
  report["searched_alone"] = check.searched_alone;
  report["engine"] = word_of(check.engine);
  report["isa"] = name(p.isa);
  report["question"] = json_question(check.request, search);
  report["seconds"] = json_seconds(check.seconds);
}

Json json_trajectory(const TrajectoryCheck& check, const SearchOptions& search) {
  Json report;
  report["verdict"] = json_name(check.verdict);
  report["claim"] = describe_trajectory_claim(check);
  report["reason"] = describe(check.reason);
  add_trajectory_question(report, check, search);
  report["excluded"] = excluded_count(check);
  report["segment"] = json_segment(check);
  const bool has_witness = check.deciding && check.deciding->preparation;
  report["witness"] =
      has_witness ? json_witness(*check.deciding->preparation, check.deciding->result) : Json();
  return report;
}

}  // namespace regulus
