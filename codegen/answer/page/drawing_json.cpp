// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/page/drawing_json.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "codegen/answer/certificate/certificate_expression_writer.hpp"
#include "codegen/model/drawing.hpp"
#include "codegen/model/exact/exact_algebra.hpp"
#include "codegen/model/mechanism/orientation.hpp"
#include "codegen/model/mechanism/serial.hpp"
#include "codegen/question/solve/nominal.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

std::set<std::string> names_of(const Model& model) {
  std::set<std::string> names;
  for (const GeometryParameter& g : model.geometry) names.insert(g.name);
  for (const PoseParameter& p : model.pose) names.insert(p.name);
  return names;
}

std::set<std::string> names_of(const Request& request) {
  std::set<std::string> names = names_of(request.model);
  for (const MotionParameter& p : request.motion.parameters) names.insert(p.name);
  return names;
}

/// The legs of a platform in space, turned by a quaternion of any length but 0.
Drawing drawing_by_quaternion(const Model& model) {
  const NominalGeometry nominal(model);
  const auto fixed = [&nominal](const Point& p) {
    return Point{nominal.at(p[0]), nominal.at(p[1]), nominal.at(p[2])};
  };
  std::vector<GiNaC::ex> quaternion;
  for (const char* part : {"qw", "qx", "qy", "qz"}) quaternion.push_back(GiNaC::realsymbol(part));
  const auto [S, N] = scaled_rotation(Orientation::kQuaternion, quaternion);
  const Point origin = {model.pose[0].symbol, model.pose[1].symbol, model.pose[2].symbol};
  using Kind = Drawing::Kind;
  Drawing::Part base{Kind::kBase, {}}, platform{Kind::kPlatform, {}};
  std::vector<Drawing::Part> legs;
  for (const ExtensibleLeg& leg : model.legs) {
    base.points.push_back(fixed(leg.base));
    platform.points.push_back(sum(origin, scaled(1 / N, times(S, fixed(leg.platform)))));
    legs.push_back(
        {Kind::kLeg, {base.points.back(), platform.points.back()}, static_cast<int>(legs.size())});
  }
  legs.insert(legs.begin(), {base, platform});
  return {std::move(legs)};
}

/// Returns the unit of lengths; "1" if the model does not say it.
std::string unit_of_lengths(const Model& model) {
  if (model.arm) return model.arm->unit;
  for (const PoseParameter& p : model.pose)
    if (p.name == "x" || p.name == "y" || p.name == "z") return p.unit;
  return "1";
}

class DrawingWriter {
 public:
  DrawingWriter(const Model& model, std::set<std::string> names)
      : unit_(unit_of_lengths(model)), expressions_(std::move(names)) {}

  Json write(const Drawing& drawing) {
    for (const Drawing::Part& part : drawing.parts)
      for (const Point& point : part.points)
        for (const GiNaC::ex& coordinate : point) expressions_.announce(coordinate);
    Json parts = Json::array();
    for (const Drawing::Part& part : drawing.parts) {
      Json numbers = Json::array();
      for (const Point& point : part.points) numbers.push_back(number_of(point));
      parts.push_back({{"kind", name(part.kind)}, {"row", part.row}, {"points", numbers}});
    }
    return {{"unit", unit_}, {"lets", json_lets()}, {"points", points_}, {"parts", parts}};
  }

 private:
  /// A point that several parts share has one number.
  std::size_t number_of(const Point& point) {
    Json texts = Json::array();
    for (const GiNaC::ex& coordinate : point)
      texts.push_back(expressions_.write(coordinate, lets_));
    const auto [place, is_new] = numbers_.emplace(texts.dump(), points_.size());
    if (is_new) points_.push_back(texts);
    return place->second;
  }

  /// The lines `let NAME = E` as pairs.
  Json json_lets() const {
    Json lets = Json::array();
    std::istringstream lines(lets_);
    for (std::string line; std::getline(lines, line);) {
      const std::size_t name = line.find(' ') + 1, equals = line.find(" = ");
      lets.push_back({line.substr(name, equals - name), line.substr(equals + 3)});
    }
    return lets;
  }

  std::string unit_;
  CertificateExpressionWriter expressions_;
  std::string lets_;
  std::map<std::string, std::size_t> numbers_;
  Json points_ = Json::array();
};

}  // namespace

Json json_drawing(const Request& request) {
  if (!request.model.drawing) return nullptr;
  return DrawingWriter(request.model, names_of(request)).write(*request.model.drawing);
}

Json json_drawing_at_solutions(const Model& model) {
  if (model.legs.size() == 6) {
    std::set<std::string> names = {"qw", "qx", "qy", "qz"};
    for (std::size_t i = 0; i < 3; ++i) names.insert(model.pose[i].name);
    return DrawingWriter(model, std::move(names)).write(drawing_by_quaternion(model));
  }
  if (!model.drawing) return nullptr;
  Json json = DrawingWriter(model, names_of(model)).write(*model.drawing);
  Json lets = Json::array();
  for (const GeometryParameter& g : model.geometry)
    lets.push_back({g.name, expression_text(g.value)});
  for (Json& let : json["lets"]) lets.push_back(std::move(let));
  json["lets"] = std::move(lets);
  return json;
}

}  // namespace regulus::detail
