// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/certificate/certificate_question.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

#include "codegen/answer/certificate/certificate_expression_writer.hpp"
#include "codegen/model/closure_start.hpp"
#include "runtime/proof/format.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/question.hpp"
#include "runtime/verifier/rounding.hpp"
#include "runtime/verifier/verify.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

class QuestionText {
 public:
  QuestionText(const Request& request, const std::set<std::string>& uncertain)
      : model_(request.model),
        motion_(request.motion),
        uncertain_(uncertain),
        lines_(names(request)) {}

  std::string text() {
    put("model", model_.name);
    put("sha256", model_.sha256.empty() ? "-" : model_.sha256);
    put("motion", motion_.name);
    put("alpha", expression_text(motion_.alpha));
    for (const MotionParameter& p : motion_.parameters)
      put("parameter",
          p.name + " in " + expression_text(p.range.lo) + " : " + expression_text(p.range.hi));
    text_ += geometry_lines(model_, uncertain_);
    write_poses();
    if (model_.closure) write_start(*model_.closure);
    write_matrix();
    for (const ex& e : motion_.must_be_defined) put("motion-defined", expression_text(e));
    for (const ex& e : motion_.reach) put("reach", expression_text(e));
    for (const ex& e : motion_.constraints) put("constraint", expression_text(e));
    return std::move(text_);
  }

 private:
  static std::set<std::string> names(const Request& request) {
    std::set<std::string> result;
    for (const GeometryParameter& g : request.model.geometry) result.insert(g.name);
    for (const PoseParameter& q : request.model.pose) result.insert(q.name);
    for (const MotionParameter& q : request.motion.parameters) result.insert(q.name);
    if (request.model.closure)
      for (const PoseParameter& q : request.model.closure->unknowns) result.insert(q.name);
    return result;
  }

  void put(const std::string& key, const std::string& value) { text_ += key + ' ' + value + '\n'; }

  void write_poses() {
    for (std::size_t i = 0; i < model_.pose.size(); ++i) {
      const ex error = motion_.error.empty() ? ex(0) : motion_.error[i];
      put("pose", model_.pose[i].name + " = " + expression_text(motion_.pose[i]) +
                      (error.is_zero() && !uncertain_.contains(model_.pose[i].name)
                           ? ""
                           : " +- " + expression_text(error)));
    }
  }

  /// Writes the unknowns of a closure with the values near which its branch begins, and the place.
  void write_start(const Closure& closure) {
    for (std::size_t i = 0; i < closure.unknowns.size(); ++i)
      put("unknown", closure.unknowns[i].name + " = " + expression_text(closure.start[i]) + " +- " +
                         expression_text(closure.start_radius[i]));
    if (motion_.parameters.empty()) return;
    for (const ex& value : start_of(model_, motion_)) put("start", expression_text(value));
  }

  /// Square roots that have values where the unknowns are within the ranges of the model.
  static std::vector<ex> within_ranges(const Closure& closure) {
    std::vector<ex> roots;
    for (std::size_t i = 0; i < closure.has_range.size(); ++i) {
      if (closure.has_range[i] == 0) continue;
      const ex& unknown = closure.unknowns[i].symbol;
      roots.push_back(GiNaC::sqrt(unknown - closure.ranges[i].lo));
      roots.push_back(GiNaC::sqrt(closure.ranges[i].hi - unknown));
    }
    return roots;
  }

  /// Writes the lines of matrix or equations, scale and defined, after the `let` lines that they
  /// use.
  void write_matrix() {
    std::vector<std::pair<std::string, ex>> lines;
    if (model_.closure)
      for (const ex& e : model_.closure->equations) lines.emplace_back("equation", e);
    for (unsigned i = 0; !model_.closure && i < model_.matrix.rows(); ++i)
      for (unsigned j = 0; j < model_.matrix.cols(); ++j)
        lines.emplace_back("entry", model_.matrix(i, j));
    for (const ex& e : model_.row_scale) lines.emplace_back("scale", e);
    for (const ex& e : model_.must_be_defined) lines.emplace_back("defined", e);
    if (model_.closure)
      for (const ex& e : within_ranges(*model_.closure)) lines.emplace_back("defined", e);
    for (const auto& [key, e] : lines) lines_.announce(e);
    std::string lets, rest;
    for (const auto& [key, e] : lines) rest += key + ' ' + lines_.write(e, lets) + '\n';
    text_ += lets;
    if (!model_.closure)
      text_ += "matrix " + std::to_string(model_.matrix.rows()) + ' ' +
               std::to_string(model_.matrix.cols()) + '\n';
    text_ += rest;
  }

  const Model& model_;
  const Motion& motion_;
  const std::set<std::string>& uncertain_;
  CertificateExpressionWriter lines_;
  std::string text_;
};

/// Throws if two symbols have one name: a certificate distinguishes symbols by name alone.
void require_distinct_names(const Request& request) {
  std::map<std::string, ex> known;
  const auto note = [&known](const std::string& name, const GiNaC::realsymbol& symbol) {
    const auto [place, is_new] = known.emplace(name, symbol);
    if (!is_new && !place->second.is_equal(symbol))
      throw UsageError("--certificate: two quantities have the name '" + name +
                       "'; rename one of them");
  };
  for (const PoseParameter& q : request.model.pose) note(q.name, q.symbol);
  for (const GeometryParameter& g : request.model.geometry) note(g.name, g.symbol);
  for (const MotionParameter& q : request.motion.parameters) note(q.name, q.symbol);
  if (request.model.closure)
    for (const PoseParameter& q : request.model.closure->unknowns) note(q.name, q.symbol);
}

/// Counts the control errors of pose parameters that are not in `uncertain`.
std::size_t other_errors(const Request& request, const std::set<std::string>& uncertain) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < request.motion.error.size(); ++i)
    if (!request.motion.error[i].is_zero() && !uncertain.contains(request.model.pose[i].name))
      ++count;
  return count;
}

/// Returns e such that every number of the question is below 2^(e + 1) in magnitude. Numbers that
/// were used only in operations between numbers are not there any more.
int largest_exponent(const verifier::Question& q) {
  std::vector<verifier::NodeId> roots{q.alpha};
  for (const verifier::Variable& v : q.variables) roots.insert(roots.end(), {v.lo, v.hi});
  for (const auto* list : {&q.matrix, &q.scale, &q.defined, &q.motion_defined, &q.constraints})
    roots.insert(roots.end(), list->begin(), list->end());
  int largest = std::numeric_limits<int>::min();
  for (const verifier::NodeId id : verifier::ingredients(q.graph, roots)) {
    const verifier::Node& node = q.graph.nodes()[static_cast<std::size_t>(id)];
    if (node.op != verifier::Op::kConstant) continue;
    const fmpq* value = q.graph.rational(node.a).get();
    if (fmpq_is_zero(value) != 0) continue;
    const auto bits = [](const fmpz* x) { return static_cast<int>(fmpz_bits(x)); };
    largest = std::max(largest, bits(fmpq_numref(value)) - bits(fmpq_denref(value)));
  }
  return largest;
}

}  // namespace

std::set<std::string> uncertain_names(const ReportLabels& subject) {
  std::set<std::string> names;
  for (const VariableLabel& v : subject.variables)
    if (v.kind == VariableKind::kGeometry) names.insert(v.name);
  return names;
}

std::set<std::string> uncertain_names(const Request& request) {
  std::set<std::string> names;
  for (const GeometryParameter& g : request.model.geometry) {
    const bool is_in_ball = g.ball >= 0;
    const auto& spread =
        is_in_ball ? request.model.balls.at(std::size_t(g.ball)).radius : g.tolerance;
    if (!spread.is_zero()) names.insert(g.name);
  }
  return names;
}

std::string geometry_lines(const Model& model, const std::set<std::string>& uncertain) {
  std::string lines;
  for (const GeometryParameter& g : model.geometry) {
    const ex spread = g.ball >= 0 ? model.balls.at(std::size_t(g.ball)).radius : g.tolerance;
    lines += uncertain.contains(g.name)
                 ? "uncertain " + g.name + " = " + expression_text(g.value) + " +- " +
                       expression_text(spread) + '\n'
                 : "constant " + g.name + " = " + expression_text(g.value) + '\n';
  }
  for (const ToleranceBall& ball : model.balls) {
    std::string members;
    for (const std::size_t i : ball.members)
      if (uncertain.contains(model.geometry[i].name)) members += ' ' + model.geometry[i].name;
    if (!members.empty()) lines += "ball" + members + '\n';
  }
  return lines;
}

format::ClaimedSet claimed_set(const Request& request, const std::set<std::string>& uncertain) {
  const GiNaC::matrix& matrix = request.model.matrix;
  return {matrix.rows(), matrix.cols(), uncertain.size() + other_errors(request, uncertain),
          expression_text(request.motion.alpha) != "0", !request.motion.reach.empty()};
}

CertifiedQuestion certified_question(const Request& request,
                                     const std::set<std::string>& uncertain) {
  require_distinct_names(request);
  const format::ClaimedSet set = claimed_set(request, uncertain);
  const auto claim = [&](bool singular) {
    return request.model.closure ? format::describe_closure_claim(set, singular)
                                 : format::describe_claim(set, singular);
  };
  return {QuestionText(request, uncertain).text(), claim(false), claim(true),
          request.model.closure ? format::describe_branch_paving(set, "") : ""};
}

std::string certificate_obstacle(const CertifiedQuestion& question, bool singular) {
  return obstacle_of_head(question.head(singular));
}

std::string obstacle_of_head(const std::string& head) {
  std::istringstream text(head);
  verifier::Lines lines(text);
  verifier::Question read;
  try {
    verifier::read_question(lines, read);
  } catch (const verifier::Rejection& why) {
    return std::string("the question is beyond the limits of the format: ") + why.what();
  }
  return "";
}

std::string certificate_doubt(const CertifiedQuestion& question, bool singular) {
  std::istringstream text(question.head(singular)), again(question.head(singular));
  verifier::Lines lines(text);
  verifier::Question read;
  verifier::read_question(lines, read);
  const int most =
      singular ? std::numeric_limits<double>::max_exponent - 1 : std::ilogb(verifier::kLargest);
  if (largest_exponent(read) > most)
    return "the question has numbers beyond 2^" + std::to_string(most) +
           ", which are too large for the verifier's bounds";
  // A head without a proof is rejected, if the verifier gets as far as that.
  const verifier::Verification tried = verifier::verify(again);
  return tried.outcome == verifier::Outcome::kUnfinished ? tried.reason : "";
}

CertifiedQuestion certified_question(const PreparedSearch& p) {
  return certified_question(p.stages->request(), uncertain_names(p.labels));
}

}  // namespace regulus::detail
