// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace regulus::codegen {
namespace {

using Json = nlohmann::ordered_json;

// JSON has no infinities; a bound that is one becomes null.
Json json_interval(const Interval& x) { return Json::array({x.lo, x.hi}); }

std::string text_interval(const Interval& x) {
  return x.lo == x.hi ? fmt::format("{}", x.lo) : fmt::format("[{}, {}]", x.lo, x.hi);
}

/// Short enough to read; never used for anything that is certified.
std::string short_interval(const Interval& x) {
  const std::string lo = fmt::format("{:.6g}", x.lo + 0.0);  // −0 reads as 0
  const std::string hi = fmt::format("{:.6g}", x.hi + 0.0);
  return lo == hi ? lo : fmt::format("[{}, {}]", lo, hi);
}

std::string unit_suffix(const std::string& unit) {
  return unit.empty() || unit == "1" ? "" : " " + unit;
}

bool is_motion(const Variable& variable) { return variable.kind == VariableKind::kMotion; }

template <class Select>
Json json_values(const Preparation& p, const std::vector<Interval>& values, Select select) {
  Json object = Json::object();
  const auto& variables = p.formulation.variables;
  for (std::size_t i = 0; i < values.size() && i < variables.size(); ++i)
    if (select(variables[i])) object[variables[i].name] = json_interval(values[i]);
  return object;
}

Json json_pose(const Preparation& p, const std::vector<Interval>& pose) {
  Json object = Json::object();
  const auto& parameters = p.request.model.pose;
  for (std::size_t i = 0; i < pose.size() && i < parameters.size(); ++i)
    object[parameters[i].name] = json_interval(pose[i]);
  return object;
}

Json json_place(const Preparation& p, const std::vector<Interval>& variables,
                const std::vector<Interval>& pose) {
  Json object = Json::object();
  object["parameters"] = json_values(p, variables, is_motion);
  object["pose"] = json_pose(p, pose);
  object["uncertain"] = json_values(p, variables, [](const Variable& v) { return !is_motion(v); });
  return object;
}

Json json_witness(const Preparation& p, const Result& result) {
  if (!result.witness) return nullptr;
  Json points = Json::array();
  for (const WitnessPoint& point : result.witness->points) {
    Json object = json_place(p, point.variables, point.pose);
    object["determinant"] = json_interval(point.determinant);
    points.push_back(std::move(object));
  }
  Json witness = {{"points", points}};
  if (!result.witness->near.empty())
    witness["near"] = json_place(p, result.witness->near, result.witness->near_pose);
  return witness;
}

Json json_leaves(const Statistics& statistics) {
  Json object = Json::object();
  for (std::size_t rule = 0; rule < kRules; ++rule)
    if (statistics.leaves[rule] != 0) object[name(Rule(rule))] = statistics.leaves[rule];
  return object;
}

Json json_seconds(const StageSeconds& s) {
  return {{"model", s.model},   {"symbolic", s.symbolic},
          {"emit", s.emit},     {"compile", s.compile},
          {"search", s.search}, {"total", s.model + s.symbolic + s.emit + s.compile + s.search}};
}

const char* json_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNoSingularity:
      return "no-singularity";
    case Verdict::kSingularity:
      return "singularity";
    case Verdict::kPossibleProblem:
      return "possible-problem";
  }
  return "";
}

std::string engine_words(const Preparation& p, const SearchOptions& search) {
  if (search.engine == Engine::kInterpreted) return "interpreted";
  return fmt::format("compiled for {}, cache {}", name(p.isa), p.cache);
}

std::string variable_lines(const Preparation& p, bool motion) {
  std::string lines;
  const auto& variables = p.formulation.variables;
  for (std::size_t i = 0; i < variables.size(); ++i)
    if (is_motion(variables[i]) == motion)
      lines += fmt::format("           {} in {}{}\n", variables[i].name,
                           short_interval(p.variety.outer[i]), unit_suffix(variables[i].unit));
  return lines;
}

std::size_t uncertain_count(const Preparation& p) {
  std::size_t count = 0;
  for (const Variable& variable : p.formulation.variables) count += !is_motion(variable);
  return count;
}

/// More than this many uncertain quantities are counted, not listed.
constexpr std::size_t kListed = 8;

std::string uncertain_lines(const Preparation& p) {
  const std::size_t count = uncertain_count(p);
  if (count == 0) return "uncertain  nothing: geometry and control are taken as exact\n";
  std::string lines = fmt::format("uncertain  {} quantities\n", count);
  return count <= kListed ? lines + variable_lines(p, false) : lines;
}

std::string place_words(const Preparation& p, const std::vector<Interval>& variables) {
  std::string words;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const Variable& variable = p.formulation.variables[i];
    if (!is_motion(variable)) continue;
    words += fmt::format("{}{} = {}", words.empty() ? "" : ", ", variable.name,
                         text_interval(variables[i]));
  }
  return words.empty() ? "the only pose" : words;
}

std::string witness_lines(const Preparation& p, const Result& result) {
  if (!result.witness) return "";
  std::string lines = "witness\n";
  for (const WitnessPoint& point : result.witness->points)
    lines += fmt::format("           determinant {} {} at {}\n",
                         point.determinant.lo == point.determinant.hi ? "=" : "in",
                         short_interval(point.determinant), place_words(p, point.variables));
  if (!result.witness->near.empty())
    lines += fmt::format("           it vanishes on the segment between them, near {}\n",
                         place_words(p, result.witness->near));
  return lines;
}

std::string blocking_lines(const Preparation& p, const Result& result) {
  if (result.blocking_box.empty()) return "";
  return fmt::format("blocked    {}\n", place_words(p, result.blocking_box));
}

std::string size_words(const Preparation& p) {
  return fmt::format("full {}×{} matrix", p.formulation.rows, p.formulation.columns);
}

}  // namespace

std::string claim(const Preparation& p, const Result& result) {
  const bool threshold = p.variety.alpha.hi > 0;
  const std::size_t uncertain = uncertain_count(p);
  const std::string set =
      uncertain == 0
          ? "every pose of the variety"
          : fmt::format("every pose of the variety and every value of the {} uncertain quantities",
                        uncertain);
  switch (result.verdict) {
    case Verdict::kNoSingularity:
      return threshold ? fmt::format("|det J⁻¹| > {} for {}", short_interval(p.variety.alpha), set)
                       : fmt::format("the {} has full rank for {}", size_words(p), set);
    case Verdict::kSingularity:
      return threshold
                 ? fmt::format("the variety holds a pose with |det J⁻¹| ≤ {}",
                               short_interval(p.variety.alpha))
                 : fmt::format("the variety holds a pose where the {} is singular", size_words(p));
    case Verdict::kPossibleProblem:
      return fmt::format("none about the {}: {}", size_words(p), describe(result.reason));
  }
  return "";
}

Json json_report(const Preparation& p, const SearchOptions& search, const Result& result) {
  Json report;
  report["verdict"] = json_name(result.verdict);
  report["claim"] = claim(p, result);
  report["reason"] = describe(result.reason);
  report["model"] = p.request.model.name;
  report["model_sha256"] = p.request.model.sha256;
  report["motion"] = p.request.motion.name;
  report["alpha"] = mid(p.variety.alpha);
  report["alpha_enclosure"] = json_interval(p.variety.alpha);
  report["method"] = name(result.method);
  report["boxes"] = result.statistics.boxes;
  report["max_frontier"] = result.statistics.max_frontier;
  report["leaves"] = json_leaves(result.statistics);
  report["probes"] = result.statistics.probes;
  report["bits"] = p.bits;
  report["witness"] = json_witness(p, result);
  report["blocking_box"] =
      result.blocking_box.empty()
          ? Json(nullptr)
          : json_values(p, result.blocking_box, [](const Variable&) { return true; });
  report["engine"] = search.engine == Engine::kInterpreted ? "interpreted" : "jit";
  report["isa"] = name(p.isa);
  report["cache"] = p.cache;
  report["seconds"] = json_seconds(p.seconds);
  return report;
}

std::string text_report(const Preparation& p, const SearchOptions& search, const Result& result) {
  const StageSeconds& s = p.seconds;
  std::string text = fmt::format("model      {}\n", p.request.model.name);
  text += fmt::format("motion     {}\n{}", p.request.motion.name, variable_lines(p, true));
  text += uncertain_lines(p);
  text += fmt::format("method     {}, {}\n", name(result.method), engine_words(p, search));
  if (!p.cache_note.empty()) text += fmt::format("           {}\n", p.cache_note);
  text += fmt::format("boxes      {} evaluated, at most {} waiting\n", result.statistics.boxes,
                      result.statistics.max_frontier);
  text += fmt::format(
      "time       model {:.1f} ms, symbolic {:.1f}, emit {:.1f}, compile {:.1f}, search {:.3f}\n",
      1e3 * s.model, 1e3 * s.symbolic, 1e3 * s.emit, 1e3 * s.compile, 1e3 * s.search);
  text += witness_lines(p, result) + blocking_lines(p, result);
  return text + fmt::format("claim      {}\n", claim(p, result));
}

}  // namespace regulus::codegen
