// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/model_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/report_parts.hpp"
#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/overrides.hpp"

namespace regulus {
namespace {

using Json = nlohmann::ordered_json;

/// Returns a constant as the model means it: exact if it is rational, otherwise six digits.
std::string text_of(const GiNaC::ex& constant) {
  const std::string exact = formula_text(constant);
  if (GiNaC::is_a<GiNaC::numeric>(constant)) return exact;
  return short_interval(enclose_constant(constant, exact));
}

std::string text_of(const Range& range) {
  const std::string lo = text_of(range.lo), hi = text_of(range.hi);
  return lo == hi ? "= " + lo : fmt::format("in [{}, {}]", lo, hi);
}

/// The members of a tolerance group, and the tolerances that they have now.
struct ToleranceGroup {
  std::string name;
  std::vector<std::string> members, tolerances;
};

std::vector<ToleranceGroup> groups_of(const Model& model) {
  std::vector<ToleranceGroup> groups;
  for (const std::string& name : tolerance_groups(model)) {
    ToleranceGroup& group = groups.emplace_back(ToleranceGroup{name, {}, {}});
    for (const GeometryParameter& g : model.geometry) {
      if (g.group != name) continue;
      group.members.push_back(g.name);
      const std::string tolerance =
          text_of(g.ball < 0 ? g.tolerance : model.balls[static_cast<std::size_t>(g.ball)].radius);
      if (std::ranges::find(group.tolerances, tolerance) == group.tolerances.end())
        group.tolerances.push_back(tolerance);
    }
  }
  return groups;
}

Json json_motion(const Motion& motion) {
  Json parameters = Json::array();
  for (const MotionParameter& p : motion.parameters)
    parameters.push_back({{"name", p.name},
                          {"unit", p.unit},
                          {"lower", text_of(p.range.lo)},
                          {"upper", text_of(p.range.hi)}});
  return {{"name", motion.name},
          {"parameters", parameters},
          {"waypoints", motion.waypoints ? Json(motion.waypoints->file) : Json()},
          {"where", name(motion.where)},
          {"constraints", motion.constraints.size()}};
}

std::vector<std::string> names_of(const std::vector<VectorSet>& sets) {
  std::vector<std::string> names;
  for (const VectorSet& set : sets) names.push_back(set.name);
  return names;
}

std::string format_motion(const Model& model, const Motion& motion) {
  std::string text = fmt::format("motion     {}\n", motion.name);
  for (const MotionParameter& p : motion.parameters)
    text += fmt::format("           {} {}{}\n", p.name, text_of(p.range), unit_suffix(p.unit));
  if (motion.waypoints)
    text += fmt::format("           along {}, {}\n", motion.waypoints->file,
                        motion.waypoints->interpolation);
  for (std::size_t i = 0; i < motion.pose.size(); ++i)
    if (!motion.pose[i].is_equal(model.pose[i].symbol))
      text += fmt::format("           {} = {}{}\n", model.pose[i].name,
                          formula_text(motion.pose[i]), unit_suffix(model.pose[i].unit));
  if (motion.where != Where::kEverywhere)
    text += fmt::format("           where {}\n", name(motion.where));
  if (!motion.constraints.empty())
    text += fmt::format("           constraints {}\n", motion.constraints.size());
  return text;
}

std::string format_group(const ToleranceGroup& group) {
  const std::string members = group.members.size() == 1
                                  ? group.members.front()
                                  : fmt::format("{} … {}, {} constants", group.members.front(),
                                                group.members.back(), group.members.size());
  return fmt::format("group      {}: tolerance {} ({})\n", group.name,
                     fmt::join(group.tolerances, ", "), members);
}

std::string format_sets(const char* kind, const std::vector<VectorSet>& sets) {
  std::string text;
  for (const VectorSet& set : sets) {
    std::vector<std::string> values;
    for (const GeometryParameter& e : set.entries)
      values.push_back(e.tolerance.is_zero() ? text_of(e.value)
                       : e.ball >= 0
                           ? text_of(e.value) + " in a ball of " + text_of(e.tolerance)
                           : text_of(Range{e.value - e.tolerance, e.value + e.tolerance}));
    text += fmt::format("{:<10} {}: {}\n", kind, set.name, fmt::join(values, ", "));
  }
  return text;
}

}  // namespace

Json json_model(const Model& model) {
  Json motions = Json::array(), groups = Json::array();
  for (const Motion& motion : model.motions) motions.push_back(json_motion(motion));
  for (const ToleranceGroup& group : groups_of(model))
    groups.push_back(
        {{"name", group.name}, {"members", group.members}, {"tolerances", group.tolerances}});
  return {{"model", model.name},
          {"model_file", model.path},
          {"source", model.source},
          {"rows", model.matrix.rows()},
          {"columns", model.matrix.cols()},
          {"motions", motions},
          {"groups", groups},
          {"loads", names_of(model.loads)},
          {"twists", names_of(model.twists)}};
}

std::string format_model(const Model& model) {
  std::string text = fmt::format("model      {}\n", model.name);
  if (!model.path.empty()) text += fmt::format("file       {}\n", model.path);
  if (!model.source.empty()) text += fmt::format("source     {}\n", model.source);
  text += fmt::format("matrix     {}×{}\n", model.matrix.rows(), model.matrix.cols());
  for (const Motion& motion : model.motions) text += format_motion(model, motion);
  for (const ToleranceGroup& group : groups_of(model)) text += format_group(group);
  return text + format_sets("load", model.loads) + format_sets("twist", model.twists);
}

}  // namespace regulus
