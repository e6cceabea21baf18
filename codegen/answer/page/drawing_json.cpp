// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/page/drawing_json.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "codegen/answer/certificate/certificate_expression_writer.hpp"
#include "codegen/model/drawing.hpp"

namespace regulus {
namespace {

using Json = nlohmann::ordered_json;

std::set<std::string> names_of(const Request& request) {
  std::set<std::string> names;
  for (const GeometryParameter& g : request.model.geometry) names.insert(g.name);
  for (const PoseParameter& p : request.model.pose) names.insert(p.name);
  for (const MotionParameter& p : request.motion.parameters) names.insert(p.name);
  return names;
}

class DrawingWriter {
 public:
  explicit DrawingWriter(const Request& request) : expressions_(names_of(request)) {}

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
    return {{"lets", json_lets()}, {"points", points_}, {"parts", parts}};
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

  CertificateExpressionWriter expressions_;
  std::string lets_;
  std::map<std::string, std::size_t> numbers_;
  Json points_ = Json::array();
};

}  // namespace

Json json_drawing(const Request& request) {
  if (!request.model.drawing) return nullptr;
  return DrawingWriter(request).write(*request.model.drawing);
}

}  // namespace regulus
