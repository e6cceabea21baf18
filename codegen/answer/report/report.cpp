// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numeric>

#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/report_parts.hpp"
#include "codegen/answer/report/undefined_report.hpp"
#include "codegen/answer/report/witness_report.hpp"
#include "codegen/question/analysis/undefined.hpp"
#include "codegen/question/engine/choices.hpp"
#include "codegen/question/engine/settings.hpp"

namespace regulus {
namespace {

using Json = nlohmann::ordered_json;

Json json_leaves(const Statistics& statistics) {
  Json object = Json::object();
  for (std::size_t rule = 0; rule < kRules; ++rule)
    if (statistics.leaves[rule] != 0) object[name(Rule(rule))] = statistics.leaves[rule];
  return object;
}

Json json_blocking_box(const PreparedSearch& p, const Result& result) {
  if (result.blocking_box.empty()) return nullptr;
  Json box = json_parameters(p, result.blocking_box);
  box.update(json_uncertain(p, result.blocking_box));
  return box;
}

std::string format_blocking(const PreparedSearch& p, const Result& result) {
  if (result.blocking_box.empty()) return "";
  const std::string line = fmt::format("blocked    {}\n", describe_place(p, result.blocking_box));
  if (result.reason != Reason::kUndefined) return line;
  return line + format_undefined(p, find_undefined(p, result.blocking_box));
}

std::uint64_t rests_on(const Result& result, std::size_t filter) {
  return filter < result.filter_boxes.size() ? result.filter_boxes[filter] : 0;
}

std::string format_filter(const PreparedSearch& p, const Result& result) {
  std::string lines;
  for (std::size_t i = 0; i < p.filters.size(); ++i)
    lines += fmt::format("filter     {} ({}): {} boxes rest on it\n", p.filters[i].name(),
                         p.filters[i].path(), rests_on(result, i));
  return lines;
}

Json json_filters(const PreparedSearch& p, const Result& result) {
  Json filters = Json::array();
  for (std::size_t i = 0; i < p.filters.size(); ++i)
    filters.push_back({{"path", p.filters[i].path()},
                       {"name", p.filters[i].name()},
                       {"sha256", p.filters[i].sha256()},
                       {"boxes", rests_on(result, i)}});
  return filters;
}

/// Returns the part of a claim that rests on filters of the user.
std::string reservations(const PreparedSearch& p, const Result& result) {
  const std::uint64_t certified = std::accumulate(result.statistics.leaves.begin(),
                                                  result.statistics.leaves.end(), std::uint64_t{0});
  std::string words;
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
        return fmt::format("the {} is singular at {}", describe_size(p), set);
      return threshold ? fmt::format("the variety holds a pose with |det J⁻¹| ≤ {}",
                                     threshold_text(p.variety.alpha, false))
                       : fmt::format("the variety holds a pose where the {} is singular",
                                     describe_size(p));
    case Verdict::kPossibleProblem:
      return fmt::format("none about the {}: {}", describe_size(p), describe(result.reason));
  }
  return "";
}

Json json_report(const PreparedSearch& p, const SearchOptions& search, const Result& result,
                 const std::optional<LeastSingular>& nearest) {
  Json report;
  report["verdict"] = json_name(result.verdict);
  report["claim"] = claim(p, result);
  report["reason"] = describe(result.reason);
  report["nonempty"] = json_occupancy(result);
  report["model"] = p.labels.model;
  report["model_file"] = p.model_file;
  report["notes"] = p.labels.notes;
  report["model_sha256"] = p.labels.model_sha256;
  report["motion"] = p.labels.motion;
  report["where"] = p.labels.where;
  report["matrix"] = name(p.labels.matrix_kind);
  report["matrix_notes"] = p.labels.matrix_notes;
  report["alpha"] = mid(p.variety.alpha);
  report["alpha_enclosure"] = json_interval(p.variety.alpha);
  report["method"] = name(result.method);
  report["without"] = search.without;
  report["forms"] = json_forms(p);
  report["boxes"] = result.statistics.boxes;
  report["max_frontier"] = result.statistics.max_frontier;
  report["leaves"] = json_leaves(result.statistics);
  report["filters"] = json_filters(p, result);
  report["probes"] = result.statistics.probes;
  report["bits"] = p.bits;
  report["witness"] = json_witness(p, result);
  report["blocking_box"] = json_blocking_box(p, result);
  if (nearest) report["nearest_singular"] = json_nearest(p, *nearest);
  if (result.reason == Reason::kUndefined && !result.blocking_box.empty())
    report["undefined"] = json_undefined(p, find_undefined(p, result.blocking_box));
  report["question"] = json_question(p, search);
  report["engine"] = word_of(search.engine);
  report["engine_boxes"] = json_engine_boxes(p, search, result.statistics.boxes);
  report["isa"] = name(p.isa);
  report["cache"] = p.cache;
  report["threads"] = settings_from(search).threads;
  report["seconds"] = json_seconds(p.seconds_spent());
  return report;
}

std::string text_report(const PreparedSearch& p, const SearchOptions& search, const Result& result,
                        const std::optional<LeastSingular>& nearest) {
  std::string text =
      format_question(p) + format_method(p, search, result.method, result.statistics.boxes);
  text += format_filter(p, result);
  text += fmt::format("boxes      {} evaluated, at most {} waiting\n", result.statistics.boxes,
                      result.statistics.max_frontier);
  // The time for these lines counts, too.
  const std::string findings = format_witness(p, result) + format_blocking(p, result) +
                               format_nearest(p, nearest) + format_occupancy(result);
  text += format_time(p.seconds_spent()) + findings;
  return text + fmt::format("claim      {}\n", claim(p, result));
}

}  // namespace regulus
