// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/report/question_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "codegen/engine/choices.hpp"
#include "codegen/engine/settings.hpp"
#include "codegen/report/report_parts.hpp"
#include "regulus/version.hpp"

namespace regulus::inline report {
namespace {

using Json = nlohmann::ordered_json;

/// The groups that are described; more are counted.
constexpr std::size_t kDescribed = 6;

/// Returns the constant of the model; nullptr for a control error.
const GeometryParameter* constant_of(const PreparedSearch& p, const VariableLabel& variable) {
  if (variable.kind != VariableKind::kGeometry) return nullptr;
  const auto& geometry = p.stages->request().model.geometry;
  const auto at = std::ranges::find(geometry, variable.name, &GeometryParameter::name);
  return at == geometry.end() ? nullptr : &*at;
}

const char* word_of_kind(const VariableLabel& variable) {
  return variable.kind == VariableKind::kControl ? "control" : "geometry";
}

/// Returns the options that may change the answer or its time, by their names on the command line.
Json json_options(const SearchOptions& search) {
  const auto limit = [](auto value) { return value == 0 ? Json(nullptr) : Json(value); };
  return {{"method", name(search.method)},
          {"determinant", word_of(search.determinant)},
          {"entries", word_of(search.entries)},
          {"bisect", word_of(search.bisection)},
          {"uncertainty", word_of(search.uncertainty)},
          {"engine", word_of(search.engine)},
          {"threads", settings_from(search).threads},
          {"max_boxes", limit(search.max_boxes)},
          {"time_limit", limit(search.time_limit)},
          {"precision", search.precision},
          {"symbolic_budget", search.symbolic_budget},
          {"without", search.without}};
}

Json json_quantity(const PreparedSearch& p, std::size_t index) {
  const VariableLabel& variable = p.labels.variables[index];
  const GeometryParameter* const constant = constant_of(p, variable);
  return {{"name", variable.name},
          {"kind", word_of_kind(variable)},
          {"group", constant == nullptr ? "" : constant->group},
          {"shape", constant != nullptr && constant->ball >= 0 ? "ball" : "range"},
          {"unit", variable.unit},
          {"range", json_interval(p.variety.outer[index])}};
}

/// Returns "base ±0.05": six digits, for people.
std::string describe_tolerance(const PreparedSearch& p, std::size_t index) {
  const VariableLabel& variable = p.labels.variables[index];
  const GeometryParameter* const constant = constant_of(p, variable);
  const Interval& range = p.variety.outer[index];
  const bool has_group = constant != nullptr && !constant->group.empty();
  return fmt::format("{} ±{:.6g}{}{}", has_group ? constant->group : variable.name,
                     (range.hi - range.lo) / 2, unit_suffix(variable.unit),
                     constant != nullptr && constant->ball >= 0 ? " in balls" : "");
}

}  // namespace

Json json_question(const PreparedSearch& p, const SearchOptions& search) {
  Json ranges = Json::object(), uncertain = Json::array();
  for (std::size_t i = 0; i < p.labels.variables.size(); ++i)
    if (is_motion(p.labels.variables[i]))
      ranges[p.labels.variables[i].name] = json_interval(p.variety.outer[i]);
    else
      uncertain.push_back(json_quantity(p, i));
  return {{"ranges", ranges},
          {"uncertain", uncertain},
          {"alpha", json_interval(p.variety.alpha)},
          {"where", p.labels.where},
          {"constraints", p.labels.constraints},
          {"options", json_options(search)},
          {"version", kVersion}};
}

std::string describe_tolerances(const PreparedSearch& p) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < p.labels.variables.size(); ++i) {
    if (is_motion(p.labels.variables[i])) continue;
    const std::string one = describe_tolerance(p, i);
    if (std::ranges::find(words, one) == words.end()) words.push_back(one);
  }
  const std::size_t left = words.size() > kDescribed ? words.size() - kDescribed : 0;
  words.resize(words.size() - left);
  return fmt::format("{}{}", fmt::join(words, ", "),
                     left > 0 ? fmt::format(" and {} more", left) : "");
}

}  // namespace regulus::report
