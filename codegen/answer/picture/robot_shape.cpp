// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/picture/robot_shape.hpp"

#include <algorithm>
#include <cmath>

#include "codegen/model/drawing.hpp"
#include "codegen/model/exact/sign.hpp"
#include "codegen/support/errors.hpp"

namespace regulus {
namespace {

using Kind = Drawing::Kind;

/// Returns the symbol of the pose parameter, or 0 if there is none of this name.
GiNaC::ex symbol_of(const Model& model, const std::string& name) {
  const auto at = std::ranges::find(model.pose, name, &PoseParameter::name);
  return at == model.pose.end() ? GiNaC::ex(0) : GiNaC::ex(at->symbol);
}

bool is_plane(const Drawing& drawing) {
  return std::ranges::all_of(drawing.parts, [](const Drawing::Part& part) {
    return std::ranges::all_of(part.points, [](const Point& p) { return p[2].is_zero(); });
  });
}

bool has_point(const Drawing& drawing, const GiNaC::ex& x, const GiNaC::ex& y) {
  return std::ranges::any_of(drawing.parts, [&](const Drawing::Part& part) {
    return std::ranges::any_of(
        part.points, [&](const Point& p) { return p[0].is_equal(x) && p[1].is_equal(y); });
  });
}

/// Returns the values of all symbols: constants as they are meant, parameters at their middles.
GiNaC::exmap values_at(const PreparedSearch& p, const std::optional<Slice>& slice) {
  const Request& request = p.stages->request();
  GiNaC::exmap values;
  for (const GeometryParameter& g : request.model.geometry) values[g.symbol] = g.value;
  const auto& variables = p.labels.variables;
  for (const MotionParameter& parameter : request.motion.parameters)
    for (std::size_t k = 0; k < variables.size(); ++k)
      if (variables[k].name == parameter.name)
        values[parameter.symbol] =
            slice && slice->axis == k ? slice->value : mid(p.variety.outer[k]);
  for (std::size_t i = 0; i < request.model.pose.size(); ++i)
    if (const GiNaC::ex symbol = request.model.pose[i].symbol; !values.contains(symbol))
      values[symbol] = request.motion.pose[i].subs(values);
  return values;
}

/// Points without a value are left out: the robot does not reach the pose.
std::vector<PlacePoint> places_of(const std::vector<Point>& points, const GiNaC::exmap& values) {
  std::vector<PlacePoint> places;
  for (const Point& point : points) {
    const auto x = approx_value(point[0].subs(values)), y = approx_value(point[1].subs(values));
    if (x && y) places.push_back({*x, *y});
  }
  return places;
}

}  // namespace

void require_robot_shape(const Request& request, const SearchSubject& subject,
                         const PictureOptions& options) {
  const Drawing* const drawing = request.model.drawing.get();
  if (drawing == nullptr || !is_plane(*drawing))
    throw UsageError("--robot: the model has no points in a plane; give them in [drawing]");
  const auto symbol = [&](std::size_t k) {
    return symbol_of(request.model, subject.labels.variables[options.drawn[k]].name);
  };
  if (options.drawn.size() < 2 || !has_point(*drawing, symbol(0), symbol(1)))
    throw UsageError(
        "--robot: the axes are not the coordinates of a point of the robot; choose such two with "
        "--axes p,q");
}

void add_robot_shape(Plot& plot, const PreparedSearch& p, const PictureOptions& options,
                     const std::optional<Slice>& slice) {
  const Request& request = p.stages->request();
  const GiNaC::exmap values = values_at(p, slice);
  for (const Kind kind : {Kind::kBase, Kind::kPlatform, Kind::kLink, Kind::kRail, Kind::kLeg})
    for (const Drawing::Part& part : request.model.drawing->parts)
      if (part.kind == kind)
        plot.add_path(places_of(part.points, values), kind == Kind::kBase ? PathStyle::kBase
                                                      : kind == Kind::kPlatform
                                                          ? PathStyle::kPlatform
                                                          : PathStyle::kRod);
  const auto symbol = [&](std::size_t k) {
    return symbol_of(request.model, p.labels.variables[options.drawn[k]].name);
  };
  plot.add_path(places_of({{symbol(0), symbol(1), 0}}, values), PathStyle::kPlace);
}

}  // namespace regulus
