// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/request.hpp"

#include <algorithm>

#include "codegen/model/changes.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/model/mechanism/joint_limits.hpp"
#include "codegen/model/mechanism/reach.hpp"
#include "codegen/model/names.hpp"
#include "codegen/model/overrides.hpp"
#include "codegen/model/way/trajectory.hpp"

namespace regulus {

Assignment split_assignment(const std::string& text, const char* option) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError(std::string(option) + ": found '" + text + "', expected NAME=VALUE");
  return {text.substr(0, equals), text.substr(equals + 1)};
}

namespace {

void take_notes(Request& request, const ModelOptions& options) {
  const auto add = [&](const std::vector<std::string>& more) {
    for (const std::string& note : more)
      if (std::ranges::find(request.notes, note) == request.notes.end())
        request.notes.push_back(note);
  };
  add(request.model.warnings);
  add(request.motion.warnings);
  if (request.motion.trajectory) add(request.motion.trajectory->warnings);
  stay_within_limits(request, options);
  if (options.warn)
    for (const std::string& note : request.notes) options.warn(note);
}

}  // namespace

namespace {

/// A motion that holds every pose parameter at 0.
Motion standing_motion(const Model& model) {
  Motion motion;
  motion.name = "at";
  motion.pose.assign(model.pose.size(), 0);
  motion.error.assign(model.pose.size(), 0);
  return motion;
}

/// Returns the name of the only motion without a pose, if one may be meant.
std::string named_motion(const Model& model, const ModelOptions& options) {
  if (!options.takes_legs || !options.motion.empty() ||
      std::ranges::count_if(model.motions, &Motion::has_no_pose) != 1)
    return options.motion;
  return std::ranges::find_if(model.motions, &Motion::has_no_pose)->name;
}

Motion asked_motion(const Model& model, const ModelOptions& options) {
  std::vector<Assignment> given;
  for (const std::string& at : options.at) given.push_back(split_assignment(at, "--at"));
  const bool has_all = std::ranges::all_of(model.pose, [&given](const PoseParameter& p) {
    return std::ranges::find(given, p.name, &Assignment::name) != given.end();
  });
  Motion motion = options.motion.empty() && has_all
                      ? standing_motion(model)
                      : find_motion(model, named_motion(model, options));
  if (motion.has_no_pose() && !options.takes_legs)
    throw InputError::statement(
        "", 0,
        "the motion " + in_quotes(motion.name) +
            " has the lengths of the legs or the place of the tool, and no pose",
        "ask solve for its solutions, or name another motion", motion.name);
  for (const Assignment& one : given)
    from_option("--at", [&] { set_range(model, motion, one.name, one.value); });
  return motion;
}

}  // namespace

std::string model_text(const ModelOptions& options) {
  return options.text ? *options.text : read_model_text(options.path);
}

void apply_changes(Request& request, const ModelOptions& options) {
  for (const std::string& tolerance : options.tolerances) {
    const Assignment given = split_assignment(tolerance, "--tolerance");
    from_option("--tolerance", [&] { set_tolerance(request.model, given.name, given.value); });
  }
  for (const std::string& range : options.ranges) {
    const Assignment given = split_assignment(range, "--range");
    from_option("--range",
                [&] { set_range(request.model, request.motion, given.name, given.value); });
  }
  if (!options.alpha.empty())
    from_option("--alpha", [&] { set_alpha(request.motion, options.alpha); });
}

void stay_within_limits(Request& request, const ModelOptions& options) {
  const std::optional<Excursion> found = find_excursion(request.model, request.motion);
  if (!found) return;
  if (!options.beyond_limits)
    throw InputError::statement(
        found->file.empty() ? options.path : found->file, found->line, found->sentence,
        "stay within them, or leave them by the option beyond-limits", found->joint);
  request.notes.push_back("the question leaves the limits of joints: " + found->sentence);
}

Request read_request(const ModelOptions& options, const FormingWatch* watch) {
  return read_request(model_text(options), options, watch);
}

Request read_request(std::string_view text, const ModelOptions& options,
                     const FormingWatch* watch) {
  Request request;
  try {
    request.model = parse_model(text, options.path, options.asked, watch);
  } catch (const FormingStopped& stopped) {
    throw ReadingStopped(stopped.interrupted);
  }
  request.model.path = options.path;
  from_option("MOTION", [&] { request.motion = asked_motion(request.model, options); });
  apply_changes(request, options);
  if (!options.waypoints.empty())
    follow_waypoints(request.model, request.motion, options.waypoints);
  load_trajectory(request.model, request.motion);
  for (const std::string& tube : options.tubes)
    from_option("--tube", [&] { set_tube(request.model, request.motion, tube); });
  if (options.separates_reach && request.motion.where == Where::kEverywhere)
    restrict_to_reach(request.model, request.motion);
  take_notes(request, options);
  return request;
}

}  // namespace regulus
