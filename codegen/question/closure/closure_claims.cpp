// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/closure_claims.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/place_text.hpp"
#include "codegen/answer/report/plain_words.hpp"
#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/search_facts.hpp"
#include "codegen/question/closure/branch_threshold.hpp"
#include "codegen/question/way/trajectory_report.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

/// Returns ", which is within the range of knee," if the model gives such ranges.
std::string within_ranges(const Closure& closure) {
  std::string names;
  std::size_t count = 0;
  for (std::size_t i = 0; i < closure.has_range.size(); ++i)
    if (closure.has_range[i] != 0)
      ++count, names += (names.empty() ? "" : ", ") + closure.unknowns[i].name;
  return count == 0
             ? ""
             : fmt::format(", which is within the range{} of {},", count == 1 ? "" : "s", names);
}

}  // namespace

std::string describe_regular_branch(const PreparedClosure& prepared) {
  const std::string within = within_ranges(*prepared.request.model.closure);
  const std::string one =
      "the branch has exactly one configuration" + (within.empty() ? "," : within) + " and ";
  if (has_threshold(prepared.request)) return one + describe_threshold(prepared, true);
  return fmt::format("{}its {}×{} matrix of the equations' derivatives has full rank", one,
                     prepared.shape.unknowns, prepared.shape.unknowns);
}

std::string describe_threshold(const PreparedClosure& prepared, bool exceeded) {
  return fmt::format("|det| of its {}×{} matrix of the equations' derivatives is {} {}",
                     prepared.shape.unknowns, prepared.shape.unknowns,
                     exceeded ? "more than" : "at most",
                     threshold_text(prepared.preparation.variety.alpha, exceeded));
}

std::string describe_claim(const PreparedClosure& prepared, const ClosureFinding& found) {
  const PreparedSearch& p = prepared.preparation;
  const Verdict verdict = check_result(prepared, found).verdict;
  if (verdict == Verdict::kPossibleProblem) return nothing_proved(reason_of(found));
  if (verdict == Verdict::kSingularity)
    return describe_refuted(prepared, "the motion", found.is_refuted());
  const std::size_t uncertain = uncertain_count(p);
  return fmt::format("{}, for every {}{}", describe_regular_branch(prepared), describe_pose(p),
                     uncertain == 0 ? ""
                     : uncertain == 1
                         ? fmt::format(" and every value of the uncertain quantity ({})",
                                       describe_groups(p.labels))
                         : fmt::format(" and every value of the {} uncertain quantities ({})",
                                       uncertain, describe_groups(p.labels)));
}

std::string describe_refuted(const PreparedClosure& prepared, const std::string& where,
                             bool by_fold) {
  const std::string reached = fmt::format("the branch reaches a configuration of {} where ", where);
  if (!by_fold) return reached + describe_threshold(prepared, false);
  return fmt::format("{}its {}×{} matrix of the equations' derivatives is singular", reached,
                     prepared.shape.unknowns, prepared.shape.unknowns);
}

std::string describe_meaning(const PreparedClosure& prepared, Verdict verdict, bool by_fold,
                             const char* poses) {
  if (verdict == Verdict::kPossibleProblem) return "";
  if (verdict == Verdict::kSingularity && by_fold)
    return fmt::format("at some pose of {} the mechanism can move although the motors are locked",
                       poses);
  if (verdict == Verdict::kNoSingularity && !has_threshold(prepared.request))
    return fmt::format(
        "the mechanism cannot change its branch, or move while the motors are locked, at any pose "
        "of {}",
        poses);
  const bool exceeded = verdict == Verdict::kNoSingularity;
  return fmt::format("at {} pose of {} |det| of the equations' derivatives is {} {}",
                     exceeded ? "every" : "some", poses, exceeded ? "larger than" : "at most",
                     threshold_text(prepared.preparation.variety.alpha, exceeded));
}

Json json_pose_on(const PreparedWay& way, std::size_t piece, const Interval& s,
                  const Json& uncertain) {
  Json pose = Json::object();
  const std::vector<Interval> commanded = way.commanded(piece, s);
  for (std::size_t i = 0; i < commanded.size(); ++i) {
    const std::string& name = way.request.model.pose[i].name;
    Interval value = commanded[i];
    if (const auto error = uncertain.find(name + "_error"); error != uncertain.end())
      value += Interval((*error)[0].get<double>(), (*error)[1].get<double>());
    pose[name] = json_interval(value);
  }
  return pose;
}

void tell_below(const PreparedClosure& prepared, const PreparedWay* way,
                const std::optional<ThresholdFinding>& found, Facts& facts) {
  if (!found || !found->below) return static_cast<void>(facts.add("witness", nullptr));
  const PlaceBelow& below = *found->below;
  const PreparedSearch& p = prepared.preparation;
  const std::vector<PoseParameter>& unknowns = prepared.request.model.closure->unknowns;
  const Json uncertain = json_uncertain(p, below.place);
  Json configuration = Json::object(), pose = Json::object();
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    configuration[unknowns[i].name] = json_interval(below.unknowns[i]);
  Facts told = facts.part();
  if (way == nullptr) {
    told.say("witness", describe_place(p, below.place));
  } else {
    const Interval& s = below.place[0];
    told.say("witness", describe_segment(*way->request.motion.trajectory, below.piece, s));
    told.say("", way->pose_at(below.piece, s));
    pose = json_pose_on(*way, below.piece, s, uncertain);
  }
  told.say("", describe_configuration(prepared, below.unknowns))
      .say("", describe_uncertain_values(p, below.place))
      .say("",
           fmt::format("det of the equations' derivatives ≈ {:.9g} there", mid(below.determinant)));
  const Json point = {{"parameters", json_parameters(p, below.place)},
                      {"pose", std::move(pose)},
                      {"uncertain", uncertain},
                      {"determinant", json_interval(below.determinant)},
                      {"unknowns", std::move(configuration)}};
  told.add("points", Json::array({point})).add("approx_hadamard", nullptr);
  facts.tell_part("witness", std::move(told));
}

std::string describe_configuration(const PreparedClosure& prepared,
                                   std::span<const Interval> unknowns) {
  std::string words;
  const Closure& closure = *prepared.request.model.closure;
  for (std::size_t i = 0; i < closure.unknowns.size(); ++i) {
    const PoseParameter& unknown = closure.unknowns[i];
    words += fmt::format("{}{} = {:.9g}{}", words.empty() ? "where " : ", ", unknown.name,
                         mid(unknowns[i]), unit_suffix(unknown.unit));
  }
  return words;
}

}  // namespace regulus::detail
