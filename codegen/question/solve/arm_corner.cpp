// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/arm_corner.hpp"

#include <fmt/format.h>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/question/condition/singular_vectors.hpp"

namespace regulus::detail {
namespace {

/// The least singular value of the Jacobian where the posture is then; 0 if it is lost.
double distance_at(const ArmAtPlace& arm, const std::vector<double>& posture) {
  const std::size_t n = arm.unknowns.size();
  const Problem problem;
  RootJudge judge({problem, {0, 0, n, 0}, [&arm] { return arm.equations(false); }});
  const auto root = judge.root_near({}, posture);
  if (!root) return 0;
  const std::unique_ptr<RootSystem> equations = arm.equations(false);
  equations->evaluate({&root->values, 1}, false);
  const auto values = equations->at(0);
  std::vector<double> matrix;
  for (const Interval& entry : values->by_unknown) matrix.push_back(mid(entry));
  const auto vectors = approx_singular_vectors(matrix, n, n);
  return vectors ? vectors->values.back() : 0.0;
}

}  // namespace

Model model_towards_singular(const Request& request, const std::vector<std::string>& held,
                             const std::vector<double>& posture) {
  Model corner = request.model;
  for (std::size_t k = 0; k < corner.geometry.size(); ++k) {
    const GiNaC::ex& tolerance = corner.geometry[k].tolerance;
    if (tolerance.is_zero()) continue;
    const auto distance_with = [&](const GiNaC::ex& value) {
      Model other = request.model;
      other.geometry[k].value = value;
      return distance_at(nominal_arm_at_place(request, held, other), posture);
    };
    const GiNaC::ex low = corner.geometry[k].value - tolerance,
                    high = corner.geometry[k].value + tolerance;
    corner.geometry[k].value = distance_with(low) < distance_with(high) ? low : high;
  }
  return corner;
}

std::string uncertain_values_text(const Model& model) {
  std::string text;
  for (const GeometryParameter& g : model.geometry)
    if (!g.tolerance.is_zero())
      text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", g.name,
                          shortest_text_in(enclose_constant(g.value, g.name)));
  return text;
}

}  // namespace regulus::detail
