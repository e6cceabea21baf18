// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/fastest_twist.hpp"

#include <fmt/format.h>

#include <cmath>

#include "codegen/answer/report/vector_text.hpp"
#include "codegen/model/exact/decimal.hpp"
#include "codegen/model/exact/sign.hpp"
#include "codegen/model/mechanism/twist.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

/// Returns the middle of a JSON interval as an exact number.
ex middle_of(const nlohmann::ordered_json& interval) {
  const double lo = interval[0], hi = interval[1];
  return exact_value(lo + (hi - lo) / 2);
}

/// Returns the pose and the uncertain values of a place.
GiNaC::exmap values_at(const AttainedPlace& place, const Model& model) {
  GiNaC::exmap values;
  const auto& pose = place.json["pose"];
  const auto& uncertain = place.json["uncertain"];
  for (const PoseParameter& p : model.pose)
    if (pose.contains(p.name)) values[p.symbol] = middle_of(pose[p.name]);
  for (const GeometryParameter& g : model.geometry)
    values[g.symbol] = uncertain.contains(g.name) ? middle_of(uncertain[g.name]) : g.value;
  return values;
}

/// Returns the twist whose part in boxes is that of `place`, and whose part in balls has the largest
/// row·ẋ.
std::vector<double> fastest(const AttainedPlace& place, const std::vector<double>& row,
                            const VectorSet& set) {
  const auto& uncertain = place.json["uncertain"];
  std::vector<double> twist;
  for (const GeometryParameter& entry : set.entries)
    twist.push_back(approx_value(uncertain.contains(entry.name) ? middle_of(uncertain[entry.name])
                                                                : entry.value)
                        .value_or(0));
  for (const ToleranceBall& ball : set.balls) {
    double norm = 0;
    for (const std::size_t k : ball.members) norm = std::hypot(norm, row[k]);
    const double radius = approx_value(ball.radius).value_or(0);
    for (const std::size_t k : ball.members)
      if (norm > 0 && !uncertain.contains(set.entries[k].name)) twist[k] += radius * row[k] / norm;
  }
  return twist;
}

}  // namespace

void add_fastest_twist(AttainedPlace& place, const Request& request, const Component& component) {
  if (!place.json.contains("pose")) return;
  const Model& model = request.model;
  const GiNaC::exmap values = values_at(place, model);
  std::vector<double> row;
  for (unsigned k = 0; k < model.matrix.cols(); ++k) {
    const auto entry =
        approx_value(model.matrix(static_cast<unsigned>(component.row), k).subs(values));
    row.push_back(component.sign * entry.value_or(0));
  }
  const std::vector<double> twist = fastest(place, row, *component.set);
  place.values += fmt::format("           with the twist {}, approximately\n",
                              vector_text(twist, units_of_rates(twist_of(model))));
  place.json["twist"] = twist;
}

}  // namespace regulus::detail
