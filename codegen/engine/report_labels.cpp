// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/engine/report_labels.hpp"

namespace regulus::inline engine {

ReportLabels report_labels(const Request& request, const Formulation& formulation) {
  ReportLabels subject;
  subject.model = request.model.name;
  subject.model_sha256 = request.model.sha256;
  subject.motion = request.motion.name;
  subject.matrix_kind = request.model.matrix_kind;
  subject.matrix_notes = request.model.matrix_notes;
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
  for (const Variable& v : formulation.variables)
    subject.variables.push_back({v.name, v.unit, v.kind});
  return subject;
}

}  // namespace regulus::engine
