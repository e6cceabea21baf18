// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/model_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/angle_text.hpp"
#include "codegen/answer/report/number_text.hpp"
#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/drawing.hpp"
#include "codegen/model/exact/decimal.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/mechanism/twist.hpp"
#include "codegen/model/overrides.hpp"

namespace regulus::detail {
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

/// Returns the same for people: 0.2 and not 1/5.
std::string short_text_of(const GiNaC::ex& constant) {
  const Interval x = enclose_constant(constant, "");
  return constant.is_equal(shortest_decimal(mid(x))) ? shortest_text(mid(x)) : text_of(constant);
}

/// Returns "0.2 mm", or "0.000872665 rad (0.05 deg)".
std::string with_unit(const GiNaC::ex& constant, const std::string& unit) {
  const Interval x = enclose_constant(constant, "");
  return short_text_of(constant) + unit_suffix(unit) + degrees_text(unit, x, x);
}

/// Returns "in [-15, 15] cm".
std::string with_unit(const Range& range, const std::string& unit) {
  const std::string lo = short_text_of(range.lo), hi = short_text_of(range.hi);
  return (lo == hi ? "= " + lo : fmt::format("in [{}, {}]", lo, hi)) + unit_suffix(unit) +
         degrees_text(unit, enclose_constant(range.lo, ""), enclose_constant(range.hi, ""));
}

/// The members of a tolerance group, and the tolerances that they have now.
struct ToleranceGroup {
  std::string name;
  std::vector<std::string> members, tolerances;
  std::vector<std::string> for_people;  ///< the tolerances, with their units
};

void add_once(std::vector<std::string>& words, const std::string& word) {
  if (std::ranges::find(words, word) == words.end()) words.push_back(word);
}

std::vector<ToleranceGroup> groups_of(const Model& model) {
  std::vector<ToleranceGroup> groups;
  for (const std::string& name : tolerance_groups(model)) {
    ToleranceGroup& group = groups.emplace_back(ToleranceGroup{name, {}, {}, {}});
    for (const GeometryParameter& g : model.geometry) {
      if (g.group != name) continue;
      group.members.push_back(g.name);
      const GiNaC::ex value =
          g.ball < 0 ? g.tolerance : model.balls[static_cast<std::size_t>(g.ball)].radius;
      add_once(group.tolerances, text_of(value));
      add_once(group.for_people, with_unit(value, unit_of_constant(model.drawing.get(), g.name)));
    }
  }
  return groups;
}

void tell_motion(const Model& model, const Motion& motion, Facts& facts) {
  facts.tell("name", motion.name, "motion", motion.name);
  Json parameters = Json::array();
  for (const MotionParameter& p : motion.parameters) {
    parameters.push_back({{"name", p.name},
                          {"unit", p.unit},
                          {"lower", text_of(p.range.lo)},
                          {"upper", text_of(p.range.hi)}});
    facts.say("", p.name + ' ' + with_unit(p.range, p.unit));
  }
  facts.add("parameters", std::move(parameters)).add("waypoints", nullptr);
  if (motion.waypoints)
    facts.tell(
        "waypoints", motion.waypoints->file, "",
        fmt::format("along {}, {}", motion.waypoints->file, motion.waypoints->interpolation));
  for (std::size_t i = 0; i < motion.pose.size(); ++i)
    if (!motion.pose[i].is_equal(model.pose[i].symbol))
      facts.say("", fmt::format("{} = {}{}", model.pose[i].name, formula_text(motion.pose[i]),
                                unit_suffix(model.pose[i].unit)));
  facts.add("where", name(motion.where)).add("constraints", motion.constraints.size());
  if (motion.where != Where::kEverywhere)
    facts.say("", fmt::format("where {}", name(motion.where)));
  if (!motion.constraints.empty())
    facts.say("", fmt::format("constraints {}", motion.constraints.size()));
}

void tell_group(const ToleranceGroup& group, Facts& facts) {
  facts.add("name", group.name).add("members", group.members);
  const std::string members = group.members.size() == 1
                                  ? group.members.front()
                                  : fmt::format("{} … {}, {} constants", group.members.front(),
                                                group.members.back(), group.members.size());
  facts.tell(
      "tolerances", group.tolerances, "group",
      fmt::format("{}: tolerance {} ({})", group.name, fmt::join(group.for_people, ", "), members));
}

/// Returns "(0, 0, 0) in a ball of 100 N" for the first entry of a ball, and nothing for the others.
std::string describe_entry(const VectorSet& set, std::size_t index,
                           const std::vector<std::string>& units) {
  const GeometryParameter& e = set.entries[index];
  const std::string unit = index < units.size() ? units[index] : "";
  if (e.tolerance.is_zero()) return short_text_of(e.value) + unit_suffix(unit);
  if (e.ball < 0) return with_unit(Range{e.value - e.tolerance, e.value + e.tolerance}, unit);
  std::vector<std::string> middle;
  for (std::size_t i = 0; i < set.entries.size(); ++i) {
    if (set.entries[i].ball != e.ball) continue;
    if (middle.empty() && i < index) return "";
    middle.push_back(short_text_of(set.entries[i].value));
  }
  return fmt::format("({}) in a ball of {}", fmt::join(middle, ", "), with_unit(e.tolerance, unit));
}

/// Tells the names of loads or twists under `key`; people read their values, too.
void tell_sets(const char* key, const char* label, const std::vector<VectorSet>& sets,
               const std::vector<std::string>& units, Facts& facts) {
  Json names = Json::array();
  for (const VectorSet& set : sets) {
    std::vector<std::string> values;
    for (std::size_t i = 0; i < set.entries.size(); ++i)
      if (const std::string words = describe_entry(set, i, units); !words.empty())
        values.push_back(words);
    names.push_back(set.name);
    facts.say(label, fmt::format("{}: {}", set.name, fmt::join(values, ", ")));
  }
  facts.add(key, std::move(names));
}

/// Tells each of `all` as an object of the list `key`.
template <class List, class Tell>
void tell_list(const char* key, const List& all, const Tell& tell, Facts& facts) {
  Json list = Json::array();
  for (const auto& one : all) {
    Facts told = facts.part();
    tell(one, told);
    list.push_back(told.object());
    facts.say_lines(told.text());
  }
  facts.add(key, std::move(list));
}

std::string start_text(const std::string& name, const GiNaC::ex& value, const std::string& unit) {
  return fmt::format("{} = {}{}", name, text_of(value), unit_suffix(unit));
}

/// Tells the unknowns, and where their branch starts.
void tell_closure(const Model& model, Facts& facts) {
  const Closure& closure = *model.closure;
  Json unknowns = Json::array(), place = Json::object();
  std::string start;
  for (std::size_t i = 0; i < model.pose.size(); ++i) {
    const PoseParameter& p = model.pose[i];
    place[p.name] = text_of(closure.start_pose[i]);
    start += (start.empty() ? "" : ", ") + start_text(p.name, closure.start_pose[i], p.unit);
  }
  facts.say("closure",
            fmt::format("{}, from {}", counted(closure.equations.size(), "equation", "equations"),
                        start));
  for (std::size_t i = 0; i < closure.unknowns.size(); ++i) {
    const PoseParameter& u = closure.unknowns[i];
    unknowns.push_back({{"name", u.name},
                        {"unit", u.unit},
                        {"start", text_of(closure.start[i])},
                        {"radius", text_of(closure.start_radius[i])},
                        {"lower", text_of(closure.ranges[i].lo)},
                        {"upper", text_of(closure.ranges[i].hi)}});
    facts.say("", fmt::format("{} ± {}, {}", start_text(u.name, closure.start[i], u.unit),
                              text_of(closure.start_radius[i]), text_of(closure.ranges[i])));
  }
  facts.add("start", std::move(place)).add("unknowns", std::move(unknowns));
}

}  // namespace

void tell_contents(const Model& model, Facts& facts) {
  facts.tell("model", model.name, "model", model.name);
  facts.tell("model_file", model.path, "file", model.path);
  facts.tell("source", model.source, "source", model.source);
  facts.add("rows", model.matrix.rows()).add("columns", model.matrix.cols());
  facts.say("matrix", fmt::format("{}×{}", model.matrix.rows(), model.matrix.cols()));
  if (model.closure) tell_closure(model, facts);
  tell_list(
      "motions", model.motions,
      [&](const Motion& motion, Facts& told) { tell_motion(model, motion, told); }, facts);
  tell_list("groups", groups_of(model), tell_group, facts);
  tell_sets("loads", "load", model.loads, units_of_wrench(model, twist_of(model)), facts);
  tell_sets("twists", "twist", model.twists, units_of_rates(twist_of(model)), facts);
}

Json json_model(const Model& model) {
  Facts facts(Readers::kPrograms);
  tell_contents(model, facts);
  return facts.object();
}

std::string format_model(const Model& model) {
  return text_of_facts([&](Facts& facts) { tell_contents(model, facts); });
}

}  // namespace regulus::detail
