// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/certificate_question.hpp"

#include <algorithm>
#include <set>

#include "regulus/certificate/format.hpp"
#include "regulus/codegen/driver/expression_lines.hpp"

namespace regulus::codegen {
namespace {

using GiNaC::ex;

class QuestionText {
 public:
  explicit QuestionText(const Preparation& p)
      : p_(p),
        model_(p.stages->request().model),
        motion_(p.stages->request().motion),
        lines_(names(p)) {}

  std::string text() {
    put("model", model_.name);
    put("sha256", model_.sha256.empty() ? "-" : model_.sha256);
    put("motion", motion_.name);
    put("alpha", expression_text(motion_.alpha));
    for (const MotionParameter& p : motion_.parameters)
      put("parameter",
          p.name + " in " + expression_text(p.range.lo) + " : " + expression_text(p.range.hi));
    write_geometry();
    write_poses();
    write_matrix();
    for (const ex& e : motion_.must_be_defined) put("motion-defined", expression_text(e));
    for (const ex& e : motion_.constraints) put("constraint", expression_text(e));
    return std::move(text_);
  }

 private:
  static std::set<std::string> names(const Preparation& p) {
    std::set<std::string> result;
    for (const GeometryParameter& g : p.stages->request().model.geometry) result.insert(g.name);
    for (const PoseParameter& q : p.stages->request().model.pose) result.insert(q.name);
    for (const MotionParameter& q : p.stages->request().motion.parameters) result.insert(q.name);
    return result;
  }

  void put(const std::string& key, const std::string& value) { text_ += key + ' ' + value + '\n'; }

  [[nodiscard]] bool is_variable(const GeometryParameter& g) const {
    const auto& variables = p_.subject.variables;
    return std::any_of(variables.begin(), variables.end(), [&g](const VariableLabel& v) {
      return v.kind == VariableKind::kGeometry && v.name == g.name;
    });
  }

  void write_geometry() {
    for (const GeometryParameter& g : model_.geometry) {
      const ex spread = g.ball >= 0 ? model_.balls.at(std::size_t(g.ball)).radius : g.tolerance;
      if (is_variable(g))
        put("uncertain",
            g.name + " = " + expression_text(g.value) + " +- " + expression_text(spread));
      else
        put("constant", g.name + " = " + expression_text(g.value));
    }
    for (const ToleranceBall& ball : model_.balls) {
      std::string members;
      for (const std::size_t i : ball.members)
        if (is_variable(model_.geometry[i]))
          members += (members.empty() ? "" : " ") + model_.geometry[i].name;
      if (!members.empty()) put("ball", members);
    }
  }

  void write_poses() {
    for (std::size_t i = 0; i < model_.pose.size(); ++i) {
      const ex error = motion_.error.empty() ? ex(0) : motion_.error[i];
      put("pose", model_.pose[i].name + " = " + expression_text(motion_.pose[i]) +
                      (error.is_zero() ? "" : " +- " + expression_text(error)));
    }
  }

  /// The lines of matrix, scale and defined, after the `let` lines that they use.
  void write_matrix() {
    std::vector<std::pair<std::string, ex>> lines;
    for (unsigned i = 0; i < model_.matrix.rows(); ++i)
      for (unsigned j = 0; j < model_.matrix.cols(); ++j)
        lines.emplace_back("entry", model_.matrix(i, j));
    for (const ex& e : model_.row_scale) lines.emplace_back("scale", e);
    for (const ex& e : model_.must_be_defined) lines.emplace_back("defined", e);
    for (const auto& [key, e] : lines) lines_.announce(e);
    std::string lets, rest;
    for (const auto& [key, e] : lines) rest += key + ' ' + lines_.write(e, lets) + '\n';
    text_ += lets + "matrix " + std::to_string(model_.matrix.rows()) + ' ' +
             std::to_string(model_.matrix.cols()) + '\n' + rest;
  }

  const Preparation& p_;
  const Model& model_;
  const Motion& motion_;
  ExpressionLines lines_;
  std::string text_;
};

/// A certificate tells symbols apart by their names alone.
void require_distinct_names(const Preparation& p) {
  const Model& model = p.stages->request().model;
  std::map<std::string, ex> known;
  const auto note = [&known](const std::string& name, const GiNaC::realsymbol& symbol) {
    const auto [place, is_new] = known.emplace(name, symbol);
    if (!is_new && !place->second.is_equal(symbol))
      throw UsageError("--certificate: found two things named '" + name +
                       "', expected different names");
  };
  for (const PoseParameter& q : model.pose) note(q.name, q.symbol);
  for (const GeometryParameter& g : model.geometry) note(g.name, g.symbol);
  for (const MotionParameter& q : p.stages->request().motion.parameters) note(q.name, q.symbol);
}

}  // namespace

CertifiedQuestion certified_question(const Preparation& p) {
  require_distinct_names(p);
  const auto& variables = p.subject.variables;
  const format::ClaimedSet set{
      p.stages->request().model.matrix.rows(), p.stages->request().model.matrix.cols(),
      std::size_t(
          std::count_if(variables.begin(), variables.end(),
                        [](const VariableLabel& v) { return v.kind != VariableKind::kMotion; })),
      expression_text(p.stages->request().motion.alpha) != "0"};
  return {QuestionText(p).text(), format::claim_words(set, false), format::claim_words(set, true)};
}

}  // namespace regulus::codegen
