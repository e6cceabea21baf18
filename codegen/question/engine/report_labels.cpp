// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/report_labels.hpp"

#include <algorithm>
#include <set>

#include "codegen/kernel/symbolic/measure.hpp"
#include "codegen/model/drawing.hpp"

namespace regulus::detail {
namespace {

/// The names of the variables on which a verdict depends.
std::set<std::string> variables_in_use(const Formulation& f) {
  std::set<std::string> names;
  for (const Expressions* list : {&f.natural_matrix, &f.natural_row_scale, &f.must_be_defined,
                                  &f.constraints, &f.motion_must_be_defined})
    for (const auto& [name, count] : count_occurrences(*list)) names.insert(name);
  return names;
}

/// Returns the group of a constant; nothing for other variables.
std::string group_of(const Model& model, const Variable& variable) {
  if (variable.kind != VariableKind::kGeometry) return {};
  const auto at = std::ranges::find(model.geometry, variable.name, &GeometryParameter::name);
  return at == model.geometry.end() ? std::string() : at->group;
}

}  // namespace

ReportLabels report_labels(const Request& request, const Formulation& formulation) {
  ReportLabels subject;
  subject.model = request.model.name;
  subject.model_sha256 = request.model.sha256;
  subject.motion = request.motion.name;
  subject.matrix_kind = request.model.matrix_kind;
  subject.matrix_notes = request.model.matrix_notes;
  subject.notes = request.notes;
  subject.rows = formulation.rows;
  subject.columns = formulation.columns;
  if (formulation.rows == formulation.columns)
    subject.determinant_exponent = formulation.scaling.determinant_exponent();
  subject.where = name(request.motion.where);
  subject.reach = request.motion.reach.size();
  subject.constraints = subject.reach + request.motion.constraints.size();
  subject.detail = formulation.detail;
  for (const PoseParameter& p : request.model.pose) subject.pose.push_back({p.name, p.unit});
  subject.twist = request.model.twist;
  const std::set<std::string> used = variables_in_use(formulation);
  const bool has_matrix = !formulation.natural_matrix.empty();
  for (const Variable& v : formulation.variables)
    subject.variables.push_back(
        {v.name,
         v.kind == VariableKind::kGeometry ? unit_of_constant(request.model.drawing.get(), v.name)
                                           : v.unit,
         v.kind, has_matrix && !used.contains(v.name), group_of(request.model, v), v.ball >= 0});
  return subject;
}

}  // namespace regulus::detail
