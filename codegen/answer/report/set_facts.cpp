// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/set_facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/angle_text.hpp"
#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/place_text.hpp"
#include "codegen/answer/report/question_report.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/place.hpp"

namespace regulus::detail {
namespace {

/// Longer constraints are counted for people, not shown.
constexpr std::size_t kLongestConstraint = 80;
constexpr std::size_t kMostConstraints = 6;

std::string describe_degrees(const SearchSubject& p, std::size_t k) {
  const Interval& outer = p.variety.outer[k];
  const std::optional<Interval>& inner = p.variety.inner[k];
  return degrees_text(p.labels.variables[k].unit, inner ? end_of_range(outer.lo, inner->lo) : outer,
                      inner ? end_of_range(outer.hi, inner->hi) : outer);
}

void say_variables(const SearchSubject& p, bool motion, Facts& facts) {
  const auto& variables = p.labels.variables;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    if (is_motion(variables[i]) != motion) continue;
    const std::string range = range_text(p, i, p.variety.outer[i]);
    facts.say("", fmt::format("{} {} {}{}{}", variables[i].name, range.front() == '[' ? "in" : "=",
                              range, unit_suffix(variables[i].unit), describe_degrees(p, i)));
  }
}

/// The pose parameters that are no parameters of the motion themselves.
void say_given(const Request& request, Facts& facts) {
  const Motion& motion = request.motion;
  for (std::size_t i = 0; i < motion.pose.size(); ++i) {
    const PoseParameter& p = request.model.pose[i];
    if (motion.pose[i].is_equal(p.symbol) || p.is_deviation) continue;
    facts.say("", symbols_of(motion.pose[i]).empty()
                      ? fixed_text(p, motion.pose[i])
                      : fmt::format("{} = {}{}", p.name, formula_text(motion.pose[i]),
                                    unit_suffix(p.unit)));
  }
}

/// The question about way-points has the constants and errors of any pose; their file has the poses.
Motion at_one_pose_if_along_waypoints(Motion motion) {
  if (!motion.trajectory) return motion;
  motion.waypoints.reset();
  motion.trajectory.reset();
  for (GiNaC::ex& value : motion.pose) value = 0;
  motion.must_be_defined.clear();
  return motion;
}

void add_errors_of_lengths(const Request& request, AskedSet& set) {
  const std::vector<PlaceName> names = length_names(request.model);
  for (std::size_t i = 0; i < request.motion.legs.size(); ++i) {
    const GiNaC::ex& error = request.motion.error[i];
    if (error.is_zero()) continue;
    const Variable variable{
        names[i].name + "_error", names[i].unit, VariableKind::kControl, {-error, error}};
    const Interval size = enclose_constant(error, variable.name);
    set.subject.labels.variables.push_back({variable.name, variable.unit, variable.kind});
    set.subject.variety.outer.emplace_back(-size.hi, size.hi);
    set.subject.variety.inner.emplace_back(Interval(-size.lo, size.lo));
    set.exact.push_back(variable);
  }
}

}  // namespace

AskedSet set_of(const Request& request) {
  Motion motion = at_one_pose_if_along_waypoints(request.motion);
  // Errors of lengths are no errors of a pose.
  if (!motion.legs.empty()) std::ranges::fill(motion.error, 0);
  const Formulation shape = formulate_shape(request.model, motion);
  AskedSet set{{report_labels(request, shape), request.model.path,
                enclose_variety(request.model, motion, shape.variables), false},
               shape.variables};
  add_errors_of_lengths(request, set);
  return set;
}

void say_poses(const SearchSubject& subject, const Request& request, Facts& facts) {
  if (!facts.are_for_people()) return;
  say_variables(subject, true, facts);
  say_given(request, facts);
  say_constraints(request.motion, facts);
}

void say_constraints(const Motion& motion, Facts& facts) {
  std::size_t left = 0, shown = 0;
  for (const GiNaC::ex& constraint : motion.constraints) {
    const std::string text = formula_text(constraint);
    if (text.size() > kLongestConstraint || shown == kMostConstraints)
      ++left;
    else
      ++shown, facts.say("", text + " <= 0");
  }
  if (left > 0)
    facts.say("", fmt::format("{}{} constraint{} that --json lists", left, shown > 0 ? " more" : "",
                              left == 1 ? "" : "s"));
}

void say_where(const SearchSubject& p, Facts& facts) {
  if (p.labels.where.empty()) return;
  const bool ranges = p.labels.where == name(Where::kWithinRanges);
  facts.say("where", fmt::format("{}: poses out of reach{} are no part of the claim",
                                 p.labels.where, ranges ? " and joints out of range" : ""));
}

void say_uncertain(const SearchSubject& p, Facts& facts) {
  const std::size_t count = uncertain_count(p);
  if (count == 0) {
    facts.say("uncertain", "nothing: geometry and control are taken as exact");
    return;
  }
  facts.say("uncertain",
            fmt::format("{} {}: {}", count, count == 1 ? "quantity" : "quantities",
                        // Searches at several tolerances have one report.
                        count <= kMostListed || p.is_replanned ? describe_groups(p.labels)
                                                               : describe_tolerances(p)));
  if (count <= kMostListed) say_variables(p, false, facts);
}

void say_growing(const SearchSubject& before, const SearchSubject& grown, Facts& facts) {
  facts.say("uncertain",
            fmt::format("{}: {}", counted(uncertain_count(grown), "quantity", "quantities"),
                        describe_growing_tolerances(grown, before)));
  if (uncertain_count(grown) <= kMostListed) say_variables(before, false, facts);
}

void say_set(const Request& request, Facts& facts) {
  if (!facts.are_for_people()) return;
  const SearchSubject subject = set_of(request).subject;
  say_poses(subject, request, facts);
  say_where(subject, facts);
  say_uncertain(subject, facts);
}

std::string fixed_text(const PoseParameter& parameter, const GiNaC::ex& value) {
  const Interval x = enclose_constant(value, parameter.name);
  return fmt::format("{} = {}{}{}", parameter.name, shortest_text_in(x),
                     unit_suffix(parameter.unit), degrees_text(parameter.unit, x, x));
}

}  // namespace regulus::detail
