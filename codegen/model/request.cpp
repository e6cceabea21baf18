// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/request.hpp"

#include <algorithm>

#include "codegen/model/changes.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/model/mechanism/joint_limits.hpp"
#include "codegen/model/mechanism/reach.hpp"
#include "codegen/model/names.hpp"
#include "codegen/model/overrides.hpp"
#include "codegen/model/place.hpp"
#include "codegen/model/way/trajectory.hpp"

namespace regulus::detail {

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
    throw InputError::statement(found->file.empty() ? options.path : found->file, found->line,
                                found->sentence,
                                "stay within them, or leave them by --beyond-limits", found->joint);
  request.notes.push_back("the question leaves the limits of joints: " + found->sentence);
}

Request read_request(const ModelOptions& options, const FormingWatch* watch) {
  return read_request(model_text(options), options, watch);
}

namespace {

/// The numbers of ModelOptions::at.
std::vector<GivenNumber> numbers_at(const ModelOptions& options) {
  std::vector<GivenNumber> numbers;
  for (const std::string& at : options.at) {
    const Assignment given = split_assignment(at, "--at");
    if (given.value.find('=') != std::string::npos)
      throw UsageError("--at: " + in_quotes(at) +
                       " gives more than one value; repeat the option, one NAME=VALUE each");
    if (std::ranges::find(numbers, given.name, &GivenNumber::name) != numbers.end())
      throw UsageError("--at: " + in_quotes(given.name) + " is given twice; give one value");
    numbers.push_back({given.name, given.value});
  }
  return numbers;
}

/// The motion is at a way-point: pose parameters have their numbers, or keep those of the file.
void stand_at_waypoint(const Model& model, Motion& motion, std::span<const GivenNumber> given) {
  motion.waypoints.reset();
  motion.pose.resize(model.pose.size());
  for (std::size_t i = 0; i < model.pose.size(); ++i) {
    const PoseParameter& p = model.pose[i];
    if (std::ranges::find(given, p.name, &GivenNumber::name) != given.end())
      motion.pose[i] = 0;  // which set_number() replaces
    else if (motion.pose[i].is_equal(p.symbol))
      throw InputError::statement(
          "", 0, "nothing gives the pose parameter " + in_quotes(p.name) + " a value",
          "give the table a column of it, or give it by at", p.name);
  }
}

}  // namespace

std::string waypoints_of(const Model& model, const ModelOptions& options) {
  const std::vector<GivenNumber> at = numbers_at(options);
  Motion motion;
  from_option("MOTION", [&] { motion = asked_motion(model, options, at); });
  return motion.waypoints ? file_of_waypoints(model, motion) : "";
}

Request read_request(std::string_view text, const ModelOptions& options,
                     const FormingWatch* watch) {
  return request_of(read_model(text, options, watch), options);
}

Model read_model(std::string_view text, const ModelOptions& options, const FormingWatch* watch) {
  try {
    Model model = parse_model(text, options.path, options.asked, watch);
    model.path = options.path;
    return model;
  } catch (const FormingStopped& stopped) {
    throw ReadingStopped(stopped.interrupted);
  }
}

Request request_of(Model model, const ModelOptions& options, std::span<const GivenNumber> more) {
  Request request{std::move(model), {}};
  const std::vector<GivenNumber> at = numbers_at(options);
  std::vector<GivenNumber> all = at;
  all.insert(all.end(), more.begin(), more.end());
  from_option("MOTION", [&] { request.motion = asked_motion(request.model, options, all); });
  if (options.takes_legs && !more.empty() && request.motion.waypoints)
    stand_at_waypoint(request.model, request.motion, all);
  for (const GivenNumber& number : at)
    from_option("--at", [&] { set_number(request.model, request.motion, number); });
  for (const GivenNumber& number : more) {
    if (std::ranges::find(at, number.name, &GivenNumber::name) != at.end())
      throw InputError::statement("", 0, in_quotes(number.name) + " is given for all places, too",
                                  "give it once", number.name);
    set_number(request.model, request.motion, number);
  }
  if (!options.waypoints.empty() && !options.ranges.empty())
    throw UsageError("--range: the question follows the way-points of " +
                     in_quotes(options.waypoints) +
                     ", which have no ranges; leave --range out, and use --tube for errors around "
                     "the way");
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

}  // namespace regulus::detail
