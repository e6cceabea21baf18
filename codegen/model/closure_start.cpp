// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/closure_start.hpp"

#include <algorithm>
#include <optional>

#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/model/exact/exact_algebra.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/names.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

[[noreturn]] void refuse(const Model& model, const Motion& motion, const std::string& problem,
                         const std::string& remedy) {
  throw InputError::statement(model.path, 0, "the motion " + in_quotes(motion.name) + problem,
                              remedy, motion.name);
}

std::string with_unit(const ex& value, const std::string& unit) {
  return formula_text(value) + (unit == "1" ? "" : " " + unit);
}

bool is_at_most(const ex& a, const ex& b) {
  if (a.is_equal(b)) return true;
  const CertainSign sign = certain_sign(b - a);
  return sign == CertainSign::kPositive || sign == CertainSign::kZero;
}

void require_within(const Model& model, const Motion& motion, const MotionParameter& parameter,
                    const ex& start) {
  if (is_at_most(parameter.range.lo, start) && is_at_most(start, parameter.range.hi)) return;
  refuse(model, motion,
         " does not contain the start of [closure], where " + parameter.name + " is " +
             with_unit(start, parameter.unit),
         "widen the range of " + parameter.name + ", or move closure.start into it");
}

std::string remedy_of_ranges(const PoseParameter& parameter) {
  return "give " + parameter.name +
         " the value of closure.start, or a range that contains it; a motion by formulas begins "
         "at the start, with its parameters at their lower ends";
}

void require_equal(const Model& model, const Motion& motion, const PoseParameter& parameter,
                   const ex& value, const ex& start, const std::string& remedy) {
  if (value.is_equal(start) || certain_sign(value - start) == CertainSign::kZero) return;
  refuse(model, motion,
         " does not contain the start of [closure]: " + parameter.name + " is " +
             with_unit(value, parameter.unit) + " there, and " + with_unit(start, parameter.unit) +
             " at the start",
         remedy);
}

/// Adds the values of poses and geometry at the start to those of the motion's parameters.
GiNaC::exmap values_at_start(const Model& model, GiNaC::exmap values = {}) {
  for (std::size_t i = 0; i < model.pose.size(); ++i)
    values.emplace(model.pose[i].symbol, model.closure->start_pose[i]);
  for (const GeometryParameter& g : model.geometry) values.emplace(g.symbol, g.value);
  return values;
}

CertainSign sign_at_start(const ex& constraint, const GiNaC::exmap& values) {
  const ex value = constraint.subs(values);
  return has_symbols(value) ? CertainSign::kUnknown : certain_sign(value);
}

/// A platform with legs starts in the middle of its ranges; nobody has chosen that place.
void require_constraints(const Model& model, const Motion& motion, const GiNaC::exmap& values) {
  if (!model.legs.empty()) return;
  for (const ex& constraint : motion.constraints)
    if (sign_at_start(constraint, values) == CertainSign::kPositive)
      refuse(model, motion,
             " does not contain the start of [closure]: there the constraint " +
                 formula_text(constraint) + " <= 0 is not met",
             "change the constraint, or move closure.start to where it is met");
}

}  // namespace

std::vector<ex> start_of(const Model& model, const Motion& motion) {
  const Closure& closure = model.closure.value();
  if (motion.waypoints || motion.trajectory)
    refuse(model, motion, " follows way-points, and the start of [closure] must be a place of it",
           "give the motion by ranges of the pose parameters, or by formulas");
  std::vector<std::optional<ex>> found(motion.parameters.size());
  for (std::size_t i = 0; i < model.pose.size(); ++i) {
    const ex &value = motion.pose[i], &start = closure.start_pose[i];
    const auto at = std::ranges::find_if(
        motion.parameters, [&value](const MotionParameter& p) { return value.is_equal(p.symbol); });
    if (at == motion.parameters.end()) continue;
    std::optional<ex>& known = found[static_cast<std::size_t>(at - motion.parameters.begin())];
    if (known)
      require_equal(model, motion, model.pose[i], *known, start, remedy_of_ranges(model.pose[i]));
    require_within(model, motion, *at, start);
    known = start;
  }
  std::vector<ex> values;
  GiNaC::exmap at_start;
  for (std::size_t k = 0; k < found.size(); ++k) {
    values.push_back(found[k].value_or(motion.parameters[k].range.lo));
    at_start[motion.parameters[k].symbol] = values[k];
  }
  for (std::size_t i = 0; i < model.pose.size(); ++i)
    require_equal(model, motion, model.pose[i], motion.pose[i].subs(at_start),
                  closure.start_pose[i], remedy_of_ranges(model.pose[i]));
  return values;
}

std::vector<ex> start_within_constraints(const Model& model, const Motion& motion) {
  std::vector<ex> values = start_of(model, motion);
  GiNaC::exmap at_start;
  for (std::size_t k = 0; k < values.size(); ++k) at_start[motion.parameters[k].symbol] = values[k];
  require_constraints(model, motion, values_at_start(model, std::move(at_start)));
  return values;
}

bool is_start_in_motion(const Model& model, const Motion& motion) {
  GiNaC::exmap values;
  if (!motion.constraints.empty() && !motion.waypoints && !motion.trajectory) {
    const std::vector<ex> start = start_of(model, motion);
    for (std::size_t k = 0; k < start.size(); ++k) values[motion.parameters[k].symbol] = start[k];
  }
  values = values_at_start(model, std::move(values));
  return motion.reach.empty() &&
         std::ranges::all_of(motion.constraints, [&values](const ex& constraint) {
           const CertainSign sign = sign_at_start(constraint, values);
           return sign == CertainSign::kNegative || sign == CertainSign::kZero;
         });
}

void require_way_from_start(const Model& model, const Motion& motion) {
  const std::vector<PieceOfPose>& first = motion.trajectory->pieces.front().pose;
  for (std::size_t i = 0; i < model.pose.size(); ++i)
    require_equal(
        model, motion, model.pose[i],
        i < first.size() ? first[i].power[0] + first[i].cosine : motion.pose.at(i),
        model.closure->start_pose[i],
        "let the way-points begin at closure.start, or move closure.start to the first of "
        "them");
  require_constraints(model, motion, values_at_start(model));
}

}  // namespace regulus::detail
