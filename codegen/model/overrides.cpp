// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/overrides.hpp"

#include <algorithm>

#include "codegen/model/constants.hpp"
#include "codegen/model/degrees.hpp"
#include "codegen/model/names.hpp"
#include "codegen/model/place.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

[[noreturn]] void refuse(const std::string& problem, const std::string& remedy,
                         const std::string& symbol) {
  throw InputError::statement("", 0, problem, remedy, symbol);
}

/// Returns the word that may be meant, or all words after `lead`.
std::string remedy(std::string_view wrong, const std::vector<std::string>& words,
                   const std::string& lead) {
  return suggestion(wrong, words, lead + (words.empty() ? "none" : enumeration(words)));
}

bool is_constant(const ex& e) {
  return !GiNaC::is_a<GiNaC::symbol>(e) && std::all_of(e.begin(), e.end(), is_constant);
}

std::vector<std::string> changeable(const Model& model, const Motion& motion) {
  std::vector<std::string> names;
  for (const MotionParameter& p : motion.parameters) names.push_back(p.name);
  for (std::size_t i = 0; i < model.pose.size(); ++i)
    if (is_constant(motion.pose[i])) names.push_back(model.pose[i].name);
  return names;
}

std::vector<std::string> split(std::string_view list) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    parts.emplace_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// Returns the unit of a range; none for an unknown parameter.
std::string unit_of(const Model& model, const Motion& motion, const std::string& parameter) {
  for (const MotionParameter& p : motion.parameters)
    if (p.name == parameter) return p.unit;
  for (const PoseParameter& p : model.pose)
    if (p.name == parameter) return p.unit;
  return "1";
}

/// Frees a pose parameter that the motion holds constant.
bool free_constant(const Model& model, Motion& motion, const std::string& name,
                   const Range& range) {
  for (std::size_t i = 0; i < model.pose.size(); ++i) {
    const PoseParameter& p = model.pose[i];
    if (p.name != name || !is_constant(motion.pose[i])) continue;
    motion.pose[i] = p.symbol;
    motion.parameters.push_back({p.symbol, p.name, p.unit, range});
    return true;
  }
  return false;
}

/// One number is an error of all that are named.
void require_one_unit(const std::vector<PlaceName>& all, const std::vector<std::string>& names) {
  const PlaceName* first = nullptr;
  for (const PlaceName& p : all) {
    if (std::ranges::find(names, p.name) == names.end()) continue;
    if (first == nullptr) first = &p;
    if (p.unit != first->unit)
      refuse("one error for numbers in " + first->unit + " and in " + p.unit,
             "name the parameters of each: " + first->name + "=E and " + p.name + "=E", "tube");
  }
}

/// True if the tolerances of the groups are given in degrees. One number is the tolerance of all.
bool take_degrees(const Model& model, std::string_view groups) {
  const std::vector<std::string> wanted = split(groups);
  bool some_do = false, some_do_not = false;
  for (const GeometryParameter& g : model.geometry)
    if (std::ranges::find(wanted, g.group) != wanted.end())
      (g.takes_degrees ? some_do : some_do_not) = true;
  if (some_do && some_do_not)
    refuse(
        "one number for tolerances in degrees and for others",
        "give each group its own, and constants of [geometry] a group that no angle of a joint has",
        std::string(groups));
  return some_do;
}

}  // namespace

const Motion& find_motion(const Model& model, std::string_view name) {
  std::vector<std::string> names;
  for (const Motion& motion : model.motions) {
    if (motion.name == name) return motion;
    names.push_back(motion.name);
  }
  if (name.empty() && model.motions.size() == 1) return model.motions.front();
  if (name.empty()) refuse("no motion is given", "this model has: " + enumeration(names), "");
  refuse("no motion " + in_quotes(name), remedy(name, names, "this model has: "),
         std::string(name));
}

void set_range(const Model& model, Motion& motion, const std::string& parameter,
               std::string_view text) {
  const Place place{.file = "", .key = parameter};
  set_range(model, motion, parameter,
            parse_range(text, place, motion.must_be_defined,
                        number_unit(unit_of(model, motion, parameter))));
}

void set_range(const Model& model, Motion& motion, const std::string& parameter,
               const Range& range) {
  const auto at = std::ranges::find(motion.parameters, parameter, &MotionParameter::name);
  if (motion.waypoints)
    refuse("a motion along way-points has no ranges", "use --tube for errors around it", parameter);
  std::erase_if(motion.warnings, [&](const std::string& warning) {
    return warning.find("." + parameter + " is ") != std::string::npos;
  });
  warn_about_angle(motion.warnings, range, unit_of(model, motion, parameter),
                   {.file = "", .key = parameter}, model.arm != nullptr);
  if (at != motion.parameters.end())
    at->range = range;
  else if (!free_constant(model, motion, parameter, range))
    refuse("this motion has no range or constant " + in_quotes(parameter),
           remedy(parameter, changeable(model, motion), "it has: "), parameter);
}

void set_tube(const Model& model, Motion& motion, std::string_view tube) {
  const bool is_by_tool = !motion.tool.empty();
  const std::vector<PlaceName> known = is_by_tool            ? tool_names(model)
                                       : motion.legs.empty() ? pose_names(model)
                                                             : length_names(model);
  std::vector<GiNaC::ex>& errors = is_by_tool ? motion.tool_error : motion.error;
  errors.resize(known.size(), 0);
  std::vector<std::string> names, all;
  for (const PlaceName& p : known) all.push_back(p.name);
  const std::size_t equals = tube.find('=');
  if (equals != std::string_view::npos) {
    names = split(tube.substr(0, equals));
  } else {
    names = all;
  }
  require_one_unit(known, names);
  for (const std::string& name : names) {
    const auto at = std::ranges::find(all, name);
    if (at == all.end())
      refuse(motion.has_no_pose() ? "the place has no number " + in_quotes(name)
                                  : "no pose parameter " + in_quotes(name),
             remedy(name, all, motion.has_no_pose() ? "it has: " : "this model has: "), name);
    const auto i = static_cast<std::size_t>(at - all.begin());
    const std::string& unit = known[i].unit;
    const Place place{.file = "", .key = name};
    const ParsedExpression term =
        parse_constant(equals == std::string_view::npos ? tube : tube.substr(equals + 1), place,
                       number_unit(unit));
    append(motion.must_be_defined, term.must_be_defined);
    errors[i] = checked_nonnegative(term, place);
    warn_about_angle(motion.warnings, {-errors[i], errors[i]}, unit,
                     {.file = "", .key = "the error of " + name});
    if (is_by_tool && is_in_degrees(unit)) errors[i] *= one_degree();
  }
}

void set_alpha(Motion& motion, std::string_view alpha) {
  const Place place{.file = "", .key = "alpha"};
  const ParsedExpression term = parse_constant(alpha, place);
  append(motion.must_be_defined, term.must_be_defined);
  motion.alpha = checked_nonnegative(term, place);
}

void set_alpha(Motion& motion, const ex& alpha) {
  motion.alpha = checked_nonnegative(constant(alpha), {.file = "", .key = "alpha"});
}

void set_tolerance(Model& model, std::string_view groups, std::string_view tolerance) {
  const ParsedExpression term =
      parse_constant(tolerance, {.file = "", .key = std::string(groups)},
                     take_degrees(model, groups) ? NumberUnit::kDegrees : NumberUnit::kPlain);
  append(model.must_be_defined, term.must_be_defined);
  set_tolerance(model, groups, term.value);
}

void set_tolerance(Model& model, std::string_view groups, const ex& tolerance) {
  const ex checked =
      checked_nonnegative(constant(tolerance), {.file = "", .key = std::string(groups)});
  const std::vector<std::string> known = tolerance_groups(model);
  const std::vector<std::string> wanted = split(groups);
  for (const std::string& group : wanted)
    if (std::ranges::find(known, group) == known.end())
      refuse("no group " + in_quotes(group), remedy(group, known, "this model has: "), group);

  const auto is_wanted = [&wanted](const std::string& group) {
    return std::ranges::find(wanted, group) != wanted.end();
  };
  const ex unit = take_degrees(model, groups) ? one_degree() : ex(1);
  for (GeometryParameter& g : model.geometry)
    if (is_wanted(g.group)) g.tolerance = checked * unit;
  for (ToleranceBall& ball : model.balls)
    if (is_wanted(ball.group)) ball.radius = checked;
}

std::vector<std::string> tolerance_groups(const Model& model) {
  std::vector<std::string> groups;
  for (const GeometryParameter& g : model.geometry)
    if (!g.group.empty() && std::ranges::find(groups, g.group) == groups.end())
      groups.push_back(g.group);
  return groups;
}

}  // namespace regulus::detail
