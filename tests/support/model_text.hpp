// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/model.hpp"

namespace regulus::detail::test {

/// Returns all contents of a model except the digest of its file: later stages cannot distinguish
/// models with equal texts.
inline std::string everything_of(const Model& model) {
  std::string text = model.name + " | " + model.source + '\n';
  const auto list = [&text](const char* what, const std::vector<GiNaC::ex>& all) {
    text += what;
    for (const GiNaC::ex& e : all) text.append(" ; ").append(formula_text(e));
    text += '\n';
  };
  for (const PoseParameter& p : model.pose) text += p.name + " in " + p.unit + '\n';
  for (const GeometryParameter& g : model.geometry) {
    list(g.name.c_str(), {g.symbol, g.value, g.tolerance});
    text += g.group + " ball " + std::to_string(g.ball) + '\n';
  }
  for (const ToleranceBall& ball : model.balls) {
    list(ball.group.c_str(), {ball.radius});
    for (const std::size_t member : ball.members) text += std::to_string(member) + ' ';
  }
  for (unsigned i = 0; i < model.matrix.rows(); ++i)
    for (unsigned j = 0; j < model.matrix.cols(); ++j) list("entry", {model.matrix(i, j)});
  list("row scale", model.row_scale);
  list("defined", model.must_be_defined);
  for (const Motion& motion : model.motions) {
    text += "motion " + motion.name + '\n';
    for (const MotionParameter& p : motion.parameters)
      list((p.name + " in " + p.unit).c_str(), {p.symbol, p.range.lo, p.range.hi});
    list("pose", motion.pose);
    list("error", motion.error);
    list("constraints", motion.constraints);
    list("alpha", {motion.alpha});
    list("defined", motion.must_be_defined);
  }
  return text;
}

}  // namespace regulus::detail::test
