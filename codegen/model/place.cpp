// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/place.hpp"

#include <algorithm>
#include <array>

#include "codegen/model/constants.hpp"
#include "codegen/model/degrees.hpp"
#include "codegen/model/mechanism/serial.hpp"
#include "codegen/model/names.hpp"
#include "codegen/model/overrides.hpp"

namespace regulus::detail {
namespace {

constexpr std::array<const char*, 6> kTool = {"x", "y", "z", "roll", "pitch", "yaw"};

bool has_name(const std::vector<PlaceName>& names, const std::string& name) {
  return std::ranges::find(names, name, &PlaceName::name) != names.end();
}

/// Puts the prefix before the names if the model has one of them for a pose parameter.
std::vector<PlaceName> told_apart(const Model& model, std::vector<PlaceName> names,
                                  const char* prefix) {
  const bool is_taken = std::ranges::any_of(
      model.pose, [&names](const PoseParameter& p) { return has_name(names, p.name); });
  if (is_taken)
    for (PlaceName& name : names) name.name.insert(0, prefix);
  return names;
}

std::string listed(const std::vector<PlaceName>& names) {
  std::vector<std::string> words;
  for (const PlaceName& name : names) words.push_back(name.name);
  return enumeration(words);
}

/// A motion that holds every pose parameter at 0.
Motion standing_motion(const Model& model) {
  Motion motion;
  motion.name = "at";
  motion.pose.assign(model.pose.size(), 0);
  motion.error.assign(model.pose.size(), 0);
  return motion;
}

/// The same with numbers in the place of the pose.
Motion standing_motion(const Model& model, std::vector<GiNaC::ex> Motion::*numbers,
                       std::size_t count) {
  Motion motion = standing_motion(model);
  for (std::size_t i = 0; i < model.pose.size(); ++i) motion.pose[i] = model.pose[i].symbol;
  (motion.*numbers).assign(count, 0);
  return motion;
}

/// Returns the name of the only motion without a pose, if one may be meant.
std::string named_motion(const Model& model, const ModelOptions& options) {
  if (!options.takes_legs || !options.motion.empty() ||
      std::ranges::count_if(model.motions, &Motion::has_no_pose) != 1)
    return options.motion;
  return std::ranges::find_if(model.motions, &Motion::has_no_pose)->name;
}

/// The names of `names` without a number.
std::vector<PlaceName> missing(const std::vector<PlaceName>& names,
                               std::span<const GivenNumber> given) {
  std::vector<PlaceName> rest;
  for (const PlaceName& name : names)
    if (std::ranges::find(given, name.name, &GivenNumber::name) == given.end())
      rest.push_back(name);
  return rest;
}

/// Refuses a name that no place of the model has. `known`: the names of places; motions have those of
/// their parameters, too.
void refuse_unknown(const Model& model, const std::vector<const std::vector<PlaceName>*>& known,
                    std::span<const GivenNumber> given) {
  std::vector<std::string> words;
  for (const auto* names : known)
    for (const PlaceName& name : *names) words.push_back(name.name);
  for (const Motion& motion : model.motions)
    for (const MotionParameter& p : motion.parameters) words.push_back(p.name);
  for (const GivenNumber& number : given)
    if (std::ranges::find(words, number.name) == words.end())
      throw InputError::statement(
          "", 0, "no motion is given, and no place has a number " + in_quotes(number.name),
          suggestion(number.name, words, "places have: " + enumeration(words)), number.name);
}

/// Refuses numbers of which some are missing, where no motion can have the others.
void refuse_a_part(const std::vector<PlaceName>& names, std::span<const GivenNumber> given) {
  const std::vector<PlaceName> rest = missing(names, given);
  if (rest.empty() || rest.size() == names.size()) return;
  throw InputError::statement("", 0,
                              "no motion is given, and " + listed(rest) +
                                  (rest.size() == 1 ? " has" : " have") + " no value",
                              "give all of " + listed(names) + ", or name a motion", "");
}

[[noreturn]] void refuse_place(const std::string& problem, const std::string& remedy,
                               const std::string& symbol) {
  throw InputError::statement("", 0, problem, remedy, symbol);
}

/// A number that is set, in its unit.
ParsedExpression checked_number(const GivenNumber& given, const PlaceName& name, Motion& motion) {
  const Place place{.file = "", .key = given.name};
  const ParsedExpression term = given.value
                                    ? constant(*given.value)
                                    : parse_constant(given.text, place, number_unit(name.unit));
  append(motion.must_be_defined, term.must_be_defined);
  warn_about_angle(motion.warnings, {term.value, term.value}, name.unit, place);
  return term;
}

/// Gives a joint a value that it keeps while the others bring the tool to its place. Returns false if
/// there is no such joint.
bool hold_joint(const Model& model, Motion& motion, const GivenNumber& given) {
  const std::vector<PlaceName> joints = pose_names(model);
  const auto at = std::ranges::find(joints, given.name, &PlaceName::name);
  if (at == joints.end()) return false;
  const auto k = std::size_t(at - joints.begin());
  motion.pose[k] = checked_number(given, *at, motion).value;
  return true;
}

}  // namespace

std::vector<PlaceName> pose_names(const Model& model) {
  std::vector<PlaceName> names;
  for (const PoseParameter& p : model.pose) names.push_back({p.name, p.unit});
  return names;
}

std::vector<PlaceName> length_names(const Model& model) {
  std::vector<PlaceName> names;
  for (std::size_t i = 1; i <= model.legs.size(); ++i)
    names.push_back({"rho_" + std::to_string(i), model.pose.front().unit});
  return told_apart(model, std::move(names), "leg_");
}

std::vector<PlaceName> tool_names(const Model& model) {
  if (!model.arm) return {};
  std::vector<PlaceName> names;
  for (std::size_t i = 0; i < kTool.size(); ++i)
    names.push_back({kTool[i], i < 3 ? model.arm->unit : model.arm->angle_unit});
  return told_apart(model, std::move(names), "tool_");
}

Motion asked_motion(const Model& model, const ModelOptions& options,
                    std::span<const GivenNumber> given) {
  const std::vector<PlaceName> pose = pose_names(model), lengths = length_names(model),
                               tool = tool_names(model);
  if (options.motion.empty()) {
    if (missing(pose, given).empty()) return standing_motion(model);
    if (options.takes_legs && !lengths.empty() && missing(lengths, given).empty())
      return standing_motion(model, &Motion::legs, lengths.size());
    if (options.takes_legs && !tool.empty() && missing(tool, given).empty())
      return standing_motion(model, &Motion::tool, tool.size());
    const bool has_motion = !named_motion(model, options).empty() || model.motions.size() == 1;
    if (!has_motion) refuse_unknown(model, {&pose, &lengths, &tool}, given);
    for (const auto* names : {&pose, &lengths, &tool})
      if (!has_motion || (names == &pose && !named_motion(model, options).empty()))
        refuse_a_part(*names, given);
  }
  Motion motion = find_motion(model, named_motion(model, options));
  if (motion.has_no_pose() && !options.takes_legs)
    refuse_place("the motion " + in_quotes(motion.name) +
                     " has the lengths of the legs or the place of the tool, and no pose",
                 "ask solve for its solutions, or name another motion", motion.name);
  return motion;
}

bool keeps_value(const Model& model, const Motion& motion, std::size_t joint) {
  return !motion.tool.empty() && !motion.pose[joint].is_equal(model.pose[joint].symbol);
}

void set_number(const Model& model, Motion& motion, const GivenNumber& given) {
  const std::vector<PlaceName> lengths = length_names(model), tool = tool_names(model);
  if (!motion.has_no_pose()) {
    const bool is_known = std::ranges::find(motion.parameters, given.name,
                                            &MotionParameter::name) != motion.parameters.end() ||
                          has_name(pose_names(model), given.name);
    for (const auto* names : {&lengths, &tool})
      if (!is_known && has_name(*names, given.name))
        refuse_place("the motion " + in_quotes(motion.name) + " gives the pose, and " +
                         in_quotes(given.name) + " takes its place",
                     "give all of " + listed(*names) + " and no motion", given.name);
    if (given.value)
      set_range(model, motion, given.name, Range{*given.value, *given.value});
    else
      set_range(model, motion, given.name, given.text);
    return;
  }
  const bool is_length = !motion.legs.empty();
  const std::vector<PlaceName>& names = is_length ? lengths : tool;
  const auto at = std::ranges::find(names, given.name, &PlaceName::name);
  if (at == names.end() && !is_length && hold_joint(model, motion, given)) return;
  if (at == names.end()) {
    std::vector<std::string> words;
    for (const PlaceName& name : names) words.push_back(name.name);
    if (!is_length)
      for (const PoseParameter& p : model.pose) words.push_back(p.name);
    refuse_place("the motion " + in_quotes(motion.name) + " gives " +
                     (is_length ? "the lengths of the legs" : "the place of the tool") +
                     ", and no " + in_quotes(given.name),
                 suggestion(given.name, words, "it has: " + enumeration(words)), given.name);
  }
  const ParsedExpression number = checked_number(given, *at, motion);
  const auto k = std::size_t(at - names.begin());
  if (is_length)
    motion.legs[k] = checked_nonnegative(number, {.file = "", .key = given.name});
  else
    motion.tool[k] = is_in_degrees(at->unit) ? number.value * one_degree() : number.value;
}

std::vector<PlacedNumber> place_of(const Model& model, const Motion& motion) {
  std::vector<PlaceName> names = !motion.legs.empty()   ? length_names(model)
                                 : !motion.tool.empty() ? tool_names(model)
                                                        : pose_names(model);
  GiNaC::exmap values;
  for (const MotionParameter& p : motion.parameters) values[p.symbol] = p.range.lo;
  const std::vector<GiNaC::ex>& numbers = !motion.legs.empty()   ? motion.legs
                                          : !motion.tool.empty() ? motion.tool
                                                                 : motion.pose;
  std::vector<PlacedNumber> place;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!motion.has_no_pose() && model.pose[i].is_deviation) continue;
    const GiNaC::ex unit =
        !motion.tool.empty() && is_in_degrees(names[i].unit) ? one_degree() : GiNaC::ex(1);
    place.push_back({names[i].name, names[i].unit, numbers[i].subs(values) / unit});
  }
  for (std::size_t k = 0; k < model.pose.size(); ++k)
    if (keeps_value(model, motion, k))
      place.push_back({model.pose[k].name, model.pose[k].unit, motion.pose[k]});
  return place;
}

}  // namespace regulus::detail
