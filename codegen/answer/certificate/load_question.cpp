// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/certificate/load_question.hpp"

#include <algorithm>

#include "codegen/answer/certificate/certificate_expression_writer.hpp"
#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/certificate/piece_question.hpp"

namespace regulus::detail {

std::string vector_lines(const VectorSet& load) {
  std::string text;
  for (const GeometryParameter& c : load.entries) {
    const GiNaC::ex spread = c.ball < 0 ? c.tolerance : GiNaC::ex(0);
    text += "wrench " + expression_text(c.value) + " +- " + expression_text(spread) + '\n';
  }
  for (const ToleranceBall& ball : load.balls) {
    text += "wrench-ball " + expression_text(ball.radius) + " in";
    for (const std::size_t member : ball.members) text += ' ' + std::to_string(member + 1);
    text += '\n';
  }
  return text;
}

std::string load_lines(const Model& model, const VectorSet& load) {
  std::string text = "load " + load.name + '\n' + vector_lines(load);
  for (const Range& limit : model.actuators.force)
    text += "limits " + expression_text(limit.lo) + " : " + expression_text(limit.hi) + '\n';
  if (!model.closure)
    for (std::size_t i = model.actuators.force.size(); i < model.matrix.rows(); ++i)
      text += std::string("limits ") + format::kFree + '\n';
  return text;
}

std::string CertifiedLoad::head(const std::string& verdict) const {
  return head_text(verdict, format::describe_load_claim(set, verdict), text);
}

CertifiedLoad certified_load(const Request& request, const std::set<std::string>& uncertain,
                             const VectorSet& load) {
  const CertifiedQuestion question = request.motion.trajectory
                                         ? trajectory_question(request, uncertain)
                                         : certified_question(request, uncertain);
  return {question.text + load_lines(request.model, load), claimed_set(request, uncertain)};
}

std::string certificate_obstacle(const CertifiedLoad& question) {
  return obstacle_of_head(question.head(format::kFeasible));
}

}  // namespace regulus::detail
