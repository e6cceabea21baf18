// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/picture/robot_in_map.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "codegen/model/drawing.hpp"
#include "codegen/model/exact/sign.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using Kind = Drawing::Kind;
/// Which coordinates of a point the axes of a map are: across, up.
using Coordinates = std::array<std::size_t, 2>;

/// The other parts have directions, which are no points.
constexpr std::array kDrawn{Kind::kBase, Kind::kPlatform, Kind::kRail, Kind::kLink, Kind::kLeg};

PathStyle style_of(Kind kind) {
  switch (kind) {
    case Kind::kBase:
      return PathStyle::kBase;
    case Kind::kPlatform:
      return PathStyle::kPlatform;
    case Kind::kRail:
      return PathStyle::kRail;
    default:
      return PathStyle::kRod;
  }
}

std::vector<Point> points_of(const Drawing& drawing) {
  std::vector<Point> points;
  for (const Drawing::Part& part : drawing.parts)
    if (std::ranges::count(kDrawn, part.kind) != 0)
      points.insert(points.end(), part.points.begin(), part.points.end());
  return points;
}

/// True if --range can give it a range in the place of its value.
bool is_constant(const Request& request, std::size_t pose) {
  return approx_value(request.motion.pose[pose]).has_value();
}

/// Returns the pose parameter that a parameter of the motion is, or could be; 0 if it is none.
GiNaC::ex pose_of(const Request& request, const std::string& parameter) {
  for (std::size_t i = 0; i < request.motion.pose.size(); ++i) {
    const PoseParameter& pose = request.model.pose[i];
    if (pose.name == parameter && is_constant(request, i)) return pose.symbol;
    for (const MotionParameter& p : request.motion.parameters)
      if (p.name == parameter && request.motion.pose[i].is_equal(p.symbol)) return pose.symbol;
  }
  return 0;
}

/// True if the point moves along axis i with x alone, as far as x, and along axis j with y.
bool moves_with(const Point& p, std::size_t i, const GiNaC::ex& x, std::size_t j,
                const GiNaC::ex& y) {
  const auto rate = [&p](std::size_t axis, const GiNaC::ex& along) {
    return p[axis].diff(GiNaC::ex_to<GiNaC::symbol>(along));
  };
  return rate(i, x).is_equal(1) && rate(i, y).is_zero() && rate(j, y).is_equal(1) &&
         rate(j, x).is_zero();
}

/// Both are coordinates of a point that moves with the platform, such as the origin of its frame: a
/// point of the drawing moves as far as they do.
std::optional<Coordinates> coordinates_of(const Request& request, const std::string& across,
                                          const std::string& up) {
  const GiNaC::ex x = pose_of(request, across), y = pose_of(request, up);
  if (x.is_zero() || y.is_zero()) return std::nullopt;
  for (const Point& p : points_of(*request.model.drawing))
    for (const auto& [i, j] : {std::pair{0U, 1U}, {0U, 2U}, {1U, 2U}, {1U, 0U}, {2U, 0U}, {2U, 1U}})
      if (moves_with(p, i, x, j, y)) return Coordinates{i, j};
  return std::nullopt;
}

/// Returns the pairs "x,y" of these parameters over which the robot can be drawn.
std::vector<std::string> maps_of(const Request& request, const std::vector<std::string>& names) {
  std::vector<std::string> maps;
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t j = i + 1; j < names.size(); ++j)
      if (coordinates_of(request, names[i], names[j])) maps.push_back(names[i] + ',' + names[j]);
  return maps;
}

[[noreturn]] void refuse(const std::string& why) { throw UsageError("--robot: " + why); }

void require_points(const Model& model) {
  if (model.closure)
    refuse("a [closure] has equations and no points, so there is no robot to draw; leave it out");
  if (!model.drawing)
    refuse(
        "the model gives a matrix and no points; add them to the model file, in a section "
        "[drawing], or leave it out");
}

/// Says which of the parameters `x,y` need a range.
std::string ranges_for(const std::string& map, const std::vector<std::string>& ranged) {
  std::string words;
  for (const std::string& name : {map.substr(0, map.find(',')), map.substr(map.find(',') + 1)})
    if (std::ranges::count(ranged, name) == 0) words += " --range " + name + "=LO:HI";
  return words;
}

[[noreturn]] void refuse_map(const Request& request, const SearchSubject& subject,
                             const PictureOptions& options) {
  const auto name = [&](std::size_t k) { return subject.labels.variables[k].name; };
  std::vector<std::string> ranged, free, all;
  for (const std::size_t k : options.paving.axes) {
    ranged.push_back(name(k));
    if (options.slices.empty() || options.slices.front().axis != k) free.push_back(name(k));
  }
  for (const MotionParameter& p : request.motion.parameters) all.push_back(p.name);
  for (std::size_t i = 0; i < request.model.pose.size(); ++i)
    if (is_constant(request, i)) all.push_back(request.model.pose[i].name);
  if (const auto maps = maps_of(request, free); !maps.empty())
    refuse(fmt::format("a map of {} and {} is not about a place of the robot; choose --axes {}",
                       name(options.drawn[0]), name(options.drawn[1]),
                       fmt::join(maps, " or --axes ")));
  if (!maps_of(request, ranged).empty())
    refuse(
        fmt::format("slices of {} leave no map that is about a place of the robot; slice "
                    "another parameter, or none",
                    name(options.slices.front().axis)));
  if (const auto maps = maps_of(request, all); !maps.empty())
    refuse(fmt::format("it stands in a map of {}, which need ranges:{}", fmt::join(maps, " or of "),
                       ranges_for(maps.front(), ranged)));
  refuse(
      "no two parameters of this motion are coordinates of a point of the robot, so it has no "
      "place in a map of them; leave it out, and let --page draw the robot");
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

bool is_flat(const Drawing& drawing) {
  return std::ranges::all_of(points_of(drawing), [](const Point& p) { return p[2].is_zero(); });
}

void include(Interval& range, double x) { range = {std::min(range.lo, x), std::max(range.hi, x)}; }

}  // namespace

void require_robot_in_map(const Request& request, const SearchSubject& subject,
                          const PictureOptions& options) {
  require_points(request.model);
  const auto name = [&](std::size_t k) { return subject.labels.variables[options.drawn[k]].name; };
  if (options.drawn.size() < 2 || !coordinates_of(request, name(0), name(1)))
    refuse_map(request, subject, options);
}

RobotInMap::RobotInMap(const PreparedSearch& p, const PictureOptions& options)
    : preparation_(p), options_(options) {
  const auto name = [&](std::size_t k) { return p.labels.variables[options.drawn[k]].name; };
  coordinates_ = coordinates_of(p.stages->request(), name(0), name(1)).value();
  include_paths();
}

/// Widens the map by the paths of the robot that go beyond it, and by a margin.
void RobotInMap::include_paths() {
  constexpr double kDistance = 0.05;
  std::vector<std::optional<Slice>> slices(options_.slices.begin(), options_.slices.end());
  if (slices.empty()) slices.emplace_back();
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const Interval map = preparation_.variety.outer[options_.drawn[axis]];
    Interval& extent = extent_[axis] = map;
    for (const auto& slice : slices)
      for (const Path& path : paths_at(slice))
        for (const PlacePoint& p : path.points) include(extent, axis == 0 ? p.across : p.up);
    const double distance = kDistance * (extent.hi - extent.lo);
    extent = {extent.lo < map.lo ? extent.lo - distance : map.lo,
              extent.hi > map.hi ? extent.hi + distance : map.hi};
  }
}

/// Points without a value are left out: the robot does not reach the pose.
std::vector<RobotInMap::Path> RobotInMap::paths_at(const std::optional<Slice>& slice) const {
  const Request& request = preparation_.stages->request();
  const GiNaC::exmap values = values_at(preparation_, slice);
  const auto places = [&](const std::vector<Point>& points) {
    std::vector<PlacePoint> found;
    for (const Point& point : points) {
      const auto x = approx_value(point[coordinates_[0]].subs(values));
      const auto y = approx_value(point[coordinates_[1]].subs(values));
      if (x && y) found.push_back({*x, *y});
    }
    return found;
  };
  std::vector<Path> paths;
  for (const Kind kind : kDrawn)
    for (const Drawing::Part& part : request.model.drawing->parts)
      if (part.kind == kind) paths.push_back({style_of(kind), places(part.points)});
  Point place = {0, 0, 0};
  for (std::size_t axis = 0; axis < 2; ++axis)
    place[coordinates_[axis]] =
        pose_of(request, preparation_.labels.variables[options_.drawn[axis]].name);
  paths.push_back({PathStyle::kPlace, places({place})});
  return paths;
}

void RobotInMap::add_to(Plot& plot, const std::optional<Slice>& slice, bool has_legend) const {
  for (const Path& path : paths_at(slice)) plot.add_path(path.points, path.style);
  const Drawing& drawing = *preparation_.stages->request().model.drawing;
  if (has_legend && !is_flat(drawing))
    plot.add_rod_legend(
        fmt::format("the robot, seen along {}", "xyz"[3 - coordinates_[0] - coordinates_[1]]));
}

}  // namespace regulus::detail
