// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/formulation/variable_ranges.hpp"

#include "codegen/support/errors.hpp"

namespace regulus::detail {

Range range_at(const Model& model, const Motion& motion, const Variable& variable) {
  for (const MotionParameter& p : motion.parameters)
    if (variable.kind == VariableKind::kMotion && p.name == variable.name) return p.range;
  for (const GeometryParameter& g : model.geometry)
    if (variable.kind == VariableKind::kGeometry && g.name == variable.name) {
      const bool in_ball = g.ball >= 0;
      const GiNaC::ex spread =
          in_ball ? model.balls.at(static_cast<std::size_t>(g.ball)).radius : g.tolerance;
      return {g.value - spread, g.value + spread};
    }
  if (variable.kind != VariableKind::kControl)
    throw InternalError("the variable " + variable.name + " is not of the request");
  return variable.range;
}

}  // namespace regulus::detail
