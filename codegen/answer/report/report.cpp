// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numeric>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/place_text.hpp"
#include "codegen/answer/report/plain_words.hpp"
#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/search_facts.hpp"
#include "codegen/answer/report/undefined_report.hpp"
#include "codegen/answer/report/witness_report.hpp"
#include "codegen/question/analysis/undefined.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

Json json_blocking_box(const PreparedSearch& p, const Result& result) {
  if (result.blocking_box.empty()) return nullptr;
  Json box = json_parameters(p, result.blocking_box);
  box.update(json_uncertain(p, result.blocking_box));
  return box;
}

std::uint64_t rests_on(const Result& result, std::size_t filter) {
  return filter < result.filter_boxes.size() ? result.filter_boxes[filter] : 0;
}

void tell_filters(const PreparedSearch& p, const Result& result, Facts& facts) {
  Json filters = Json::array();
  for (std::size_t i = 0; i < p.filters.size(); ++i) {
    const FilterFile& filter = p.filters[i];
    const std::uint64_t boxes = rests_on(result, i);
    filters.push_back({{"path", filter.path()},
                       {"name", filter.name()},
                       {"sha256", filter.sha256()},
                       {"boxes", boxes}});
    facts.say("filter", fmt::format("{} ({}): {} rest{} on it", filter.name(), filter.path(),
                                    counted(boxes, "box", "boxes"), boxes == 1 ? "s" : ""));
  }
  facts.add("filters", filters);
}

/// The pose at which the uncertain quantities alone defeat the test: the middle of the blocking box,
/// as the search takes it.
void tell_blocking_pose(const PreparedSearch& p, const Result& result, Facts& facts) {
  if (result.reason != Reason::kUncertainty || uncertain_count(p) == 0) return;
  std::vector<Interval> pose = result.blocking_box;
  for (std::size_t i = 0; i < pose.size(); ++i)
    if (is_motion(p.labels.variables[i])) pose[i] = Interval(mid(pose[i]));
  facts.add("blocking_pose", json_parameters(p, pose));
  facts.say("", fmt::format("the pose is its middle, {}", describe_place(p, pose)));
}

void tell_blocking(const PreparedSearch& p, const Result& result, Facts& facts) {
  facts.add("blocking_box", json_blocking_box(p, result));
  if (result.blocking_box.empty()) return;
  facts.say("blocked", describe_place(p, result.blocking_box));
  tell_blocking_pose(p, result, facts);
  if (result.reason == Reason::kUndefined)
    tell_undefined(p, find_undefined(p, result.blocking_box), facts);
}

void tell_text(const PreparedSearch& p, Facts& facts) {
  if (!p.text) {
    facts.add("kernel", nullptr);
    return;
  }
  facts.add("kernel", {{"path", p.text->path}, {"sha256", p.text->sha256}});
  facts.say("kernel",
            fmt::format("{}: the claim is about the functions of this text", p.text->path));
}

/// Returns the part of a claim that rests on filters or on a text of the user.
std::string reservations(const PreparedSearch& p, const Result& result) {
  const std::uint64_t certified = std::accumulate(result.statistics.leaves.begin(),
                                                  result.statistics.leaves.end(), std::uint64_t{0});
  std::string words;
  if (p.text)
    words = fmt::format(
        "; by the functions of {}, of which Regulus has not proved that they are the model's",
        p.text->path);
  for (std::size_t i = 0; i < p.filters.size(); ++i)
    if (rests_on(result, i) > 0)
      words += fmt::format("; {} of {} boxes rest on the filter {}, which Regulus has not checked",
                           rests_on(result, i), certified, p.filters[i].name());
  return words;
}

}  // namespace

std::string claim(const PreparedSearch& p, const Result& result) {
  const bool threshold = p.variety.alpha.hi > 0;
  const std::size_t uncertain = uncertain_count(p);
  const std::string pose = describe_pose(p);
  const std::string set =
      uncertain == 0   ? fmt::format("every {}", pose)
      : uncertain == 1 ? fmt::format("every {} and every value of the uncertain quantity ({})",
                                     pose, describe_groups(p.labels))
                       : fmt::format("every {} and every value of the {} uncertain quantities ({})",
                                     pose, uncertain, describe_groups(p.labels));
  switch (result.verdict) {
    case Verdict::kNoSingularity:
      return (threshold
                  ? fmt::format("|det J⁻¹| > {} for {}", threshold_text(p.variety.alpha, true), set)
                  : fmt::format("the {} has full rank for {}", describe_size(p), set)) +
             reservations(p, result);
    case Verdict::kSingularity:
      if (result.reason == Reason::kAlwaysSingular)
        return fmt::format("the {} is singular at {}", describe_size(p), set) +
               (p.text ? reservations(p, result) : "");
      return (threshold ? fmt::format("the motion has a pose with |det J⁻¹| ≤ {}",
                                      threshold_text(p.variety.alpha, false))
                        : fmt::format("the motion has a pose where the {} is singular",
                                      describe_size(p))) +
             (p.text ? reservations(p, result) : "");
    case Verdict::kPossibleProblem:
      return nothing_proved(describe(result.reason));
  }
  return "";
}

Json json_leaves(const Statistics& statistics) {
  Json object = Json::object();
  for (std::size_t rule = 0; rule < kRules; ++rule)
    if (statistics.leaves[rule] != 0) object[name(Rule(rule))] = statistics.leaves[rule];
  return object;
}

void tell_boxes(const Statistics& statistics, Facts& facts) {
  facts.add("boxes", statistics.boxes).add("max_frontier", statistics.max_frontier);
  facts.add("probes", statistics.probes);
  facts.say("boxes", fmt::format("{} evaluated, at most {} waiting", statistics.boxes,
                                 statistics.max_frontier));
}

void tell_report(const PreparedSearch& p, const SearchOptions& search, const Result& result,
                 const std::optional<LeastSingular>& nearest, Facts& facts) {
  facts.add("verdict", json_name(result.verdict)).add("reason", describe(result.reason));
  tell_question(p, p.stages->request(), facts);
  if (facts.are_for_programs()) add_search(search, json_question(p, search), facts);
  tell_method(p, search, result.method, result.statistics.boxes, facts);
  tell_text(p, facts);
  tell_filters(p, result, facts);
  tell_boxes(result.statistics, facts);
  facts.add("leaves", json_leaves(result.statistics));
  Facts findings = facts.part();
  tell_witness(p, result, findings);
  tell_blocking(p, result, findings);
  if (nearest) tell_nearest(p, *nearest, findings);
  tell_occupancy(result, findings);
  tell_time(p.seconds_spent(), facts);  // of the findings, too
  facts.append(std::move(findings));
  tell_meaning(p, result.verdict, result.reason, facts);
  const std::string proved = claim(p, result);
  facts.tell("claim", proved, "claim", proved);
}

Json json_report(const PreparedSearch& p, const SearchOptions& search, const Result& result,
                 const std::optional<LeastSingular>& nearest) {
  return report_of_facts([&](Facts& facts) { tell_report(p, search, result, nearest, facts); });
}

std::string text_report(const PreparedSearch& p, const SearchOptions& search, const Result& result,
                        const std::optional<LeastSingular>& nearest) {
  return text_of_facts([&](Facts& facts) { tell_report(p, search, result, nearest, facts); });
}

}  // namespace regulus::detail
