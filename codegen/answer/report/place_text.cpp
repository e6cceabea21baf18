// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/place_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/number_text.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

std::string short_text_of(const SearchSubject&, std::size_t, const Interval& x) {
  return short_interval(x);
}

Json json_variables(const SearchSubject& p, std::span<const Interval> values, bool motion) {
  Json object = Json::object();
  const auto& variables = p.labels.variables;
  for (std::size_t i = 0; i < values.size() && i < variables.size(); ++i)
    if (is_motion(variables[i]) == motion) object[variables[i].name] = json_interval(values[i]);
  return object;
}

/// "x = 3 cm", "y in [4, 5] cm".
std::string with_sign_and_unit(const std::string& name, const std::string& value,
                               const std::string& unit) {
  return fmt::format("{} {} {}{}", name, value.front() == '[' ? "in" : "=", value,
                     unit_suffix(unit));
}

/// "x = 3 cm, y in [4, 5] cm": of the motion parameters or of the other variables.
std::string assignments(const SearchSubject& p, std::span<const Interval> values, bool motion,
                        std::string (*text)(const SearchSubject&, std::size_t, const Interval&)) {
  std::string words;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const VariableLabel& variable = p.labels.variables[i];
    if (is_motion(variable) != motion) continue;
    words += (words.empty() ? "" : ", ") +
             with_sign_and_unit(variable.name, text(p, i, values[i]), variable.unit);
  }
  return words;
}

std::string pose_words(const SearchSubject& p, std::span<const Interval> pose,
                       std::string (*text)(const Interval&)) {
  const auto& parameters = p.labels.pose;
  const auto& variables = p.labels.variables;
  bool shown = false;
  std::string words;
  for (std::size_t i = 0; i < pose.size() && i < parameters.size(); ++i) {
    shown = shown || std::ranges::find(variables, parameters[i].name, &VariableLabel::name) ==
                         variables.end();
    words += (words.empty() ? "where the pose is " : ", ") +
             with_sign_and_unit(parameters[i].name, text(pose[i]), parameters[i].unit);
  }
  return shown ? words : "";
}

}  // namespace

bool is_motion(const VariableLabel& variable) { return variable.kind == VariableKind::kMotion; }

std::size_t uncertain_count(const SearchSubject& p) {
  std::size_t count = 0;
  for (const VariableLabel& variable : p.labels.variables) count += !is_motion(variable);
  return count;
}

Interval end_of_range(double outer, double inner) {
  constexpr int kSteps = 4;
  double near = outer;
  for (int i = 0; i < kSteps; ++i) near = std::nextafter(near, inner);
  return {std::min(outer, near), std::max(outer, near)};
}

std::string range_text(const SearchSubject& p, std::size_t k, const Interval& x) {
  const Interval& outer = p.variety.outer[k];
  const std::optional<Interval>& inner = p.variety.inner[k];
  if (!inner && x.lo == outer.lo && x.hi == outer.hi) return shortest_text_in(outer);
  const bool from_first = inner && x.lo == outer.lo, to_last = inner && x.hi == outer.hi;
  return ends_text(
      from_first ? shortest_text_in(end_of_range(outer.lo, inner->lo)) : shortest_text(x.lo),
      to_last ? shortest_text_in(end_of_range(outer.hi, inner->hi)) : shortest_text(x.hi));
}

Json json_parameters(const SearchSubject& p, std::span<const Interval> variables) {
  return json_variables(p, variables, true);
}

Json json_uncertain(const SearchSubject& p, std::span<const Interval> variables) {
  return json_variables(p, variables, false);
}

Json json_pose(const SearchSubject& p, std::span<const Interval> pose) {
  Json object = Json::object();
  const auto& parameters = p.labels.pose;
  for (std::size_t i = 0; i < pose.size() && i < parameters.size(); ++i)
    object[parameters[i].name] = json_interval(pose[i]);
  return object;
}

std::string describe_place(const SearchSubject& p, std::span<const Interval> variables) {
  const std::string words = assignments(p, variables, true, range_text);
  return words.empty() ? "the only pose" : words;
}

std::string describe_short_place(const SearchSubject& p, std::span<const Interval> variables) {
  const std::string words = assignments(p, variables, true, short_text_of);
  return words.empty() ? "the only pose" : words;
}

std::string describe_uncertain_values(const SearchSubject& p, std::span<const Interval> variables) {
  const std::size_t count = uncertain_count(p);
  if (count == 0) return "";
  if (count > kMostListed)
    return fmt::format("with values of the {} uncertain quantities that --json lists", count);
  return "with " + assignments(p, variables, false, short_text_of);
}

std::string describe_pose_of(const SearchSubject& p, std::span<const Interval> pose) {
  return pose_words(p, pose, value_text);
}

std::string describe_short_pose(const SearchSubject& p, std::span<const Interval> pose) {
  return pose_words(p, pose, short_interval);
}

}  // namespace regulus::detail
