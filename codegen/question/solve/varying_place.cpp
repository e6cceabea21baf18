// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/varying_place.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "codegen/model/degrees.hpp"
#include "codegen/model/drawing.hpp"
#include "codegen/model/mechanism/serial.hpp"
#include "codegen/model/names.hpp"
#include "codegen/model/place.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

constexpr const char* kGroup = "the place";

void require_new(const Model& model, const std::string& name) {
  const bool is_known =
      std::ranges::find(model.geometry, name, &GeometryParameter::name) != model.geometry.end() ||
      std::ranges::find(model.pose, name, &PoseParameter::name) != model.pose.end();
  if (is_known)
    throw UsageError("the model has a quantity " + in_quotes(name) +
                     ", which is the name of an error of the place; rename it");
}

/// `error`: a length, or an angle in radians.
ex new_error(Model& model, const PlaceName& number, const ex& error) {
  const std::string name = number.name + "_error";
  require_new(model, name);
  GeometryParameter parameter{GiNaC::realsymbol(name), name, 0, error, kGroup};
  parameter.takes_degrees = is_in_degrees(number.unit);
  model.geometry.push_back(parameter);
  if (model.drawing) {
    Drawing drawing = *model.drawing;
    drawing.units[name] = is_in_degrees(number.unit) ? "rad" : number.unit;
    model.drawing = std::make_shared<const Drawing>(std::move(drawing));
  }
  return parameter.symbol;
}

}  // namespace

void let_place_vary(Request& request) {
  Model& model = request.model;
  Motion& motion = request.motion;
  if (!model.arm) return;
  const bool is_by_tool = !motion.tool.empty();
  const std::vector<PlaceName> names = is_by_tool ? tool_names(model) : pose_names(model);
  std::vector<ex> errors = is_by_tool ? motion.tool_error : motion.error;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (errors[i].is_zero()) continue;
    if (!is_by_tool && is_in_degrees(names[i].unit)) errors[i] *= one_degree();
    motion.added_to_place.resize(names.size(), 0);
    motion.added_to_place[i] = new_error(model, names[i], errors[i]);
  }
  motion.tool_error.clear();
  if (!is_by_tool) std::ranges::fill(motion.error, 0);
}

ex added_to_pose(const Motion& motion, std::size_t number) {
  return motion.tool.empty() && !motion.added_to_place.empty() ? motion.added_to_place[number]
                                                               : ex(0);
}

std::vector<ex> tool_within_errors(const Motion& motion) {
  std::vector<ex> tool = motion.tool;
  for (std::size_t i = 0; i < tool.size() && !motion.added_to_place.empty(); ++i)
    tool[i] += motion.added_to_place[i];
  return tool;
}

}  // namespace regulus::detail
