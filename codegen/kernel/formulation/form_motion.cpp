// SPDX-License-Identifier: GPL-3.0-or-later
// Forms the functions of the motion and the conditions for the functions of a kernel to be defined.
#include <algorithm>
#include <unordered_set>
#include <utility>

#include "codegen/kernel/formulation/formulator.hpp"

namespace regulus::detail {

Expression Formulator::rewritten(const Expression& natural, const std::string& function) {
  Rewritten form = rewriter_.rewrite(natural);
  result_.statistics[function].push_back({counted(natural), counted(form.expression), form.passes});
  return form.expression;
}

void Formulator::form_row_scale() {
  for (const GiNaC::ex& scale : model_.row_scale)
    result_.natural_row_scale.push_back(substitution_.apply(scale));
  Expressions factors = result_.natural_row_scale;
  const bool square = result_.rows == result_.columns;
  const int exponent = square ? result_.scaling.determinant_exponent() : 0;
  if (exponent != 0 && may_have_threshold()) factors.push_back(power_of_two(-exponent));
  if (factors.empty()) return;
  result_.row_scale = {rewritten(product(std::move(factors)), "row_scale")};
}

void Formulator::form_motion() {
  // A constraint cuts the variety of commanded poses; control errors are added afterwards.
  for (const GiNaC::ex& operand : motion_.reach)
    result_.constraints.push_back(rewritten(substitution_.apply_commanded(-operand), "constraint"));
  for (const GiNaC::ex& constraint : motion_.constraints)
    result_.constraints.push_back(
        rewritten(substitution_.apply_commanded(constraint), "constraint"));
  for (const PoseParameter& p : model_.pose)
    result_.pose.push_back(rewritten(substitution_.apply(p.symbol), "pose"));
}

void Formulator::collect_must_be_defined() {
  Expressions of_motion, all;
  for (const GiNaC::ex& e : motion_.must_be_defined) append_partial(e, of_motion);
  for (const GiNaC::ex& e : motion_.pose) append_partial(e, of_motion);
  all = of_motion;
  for (const GiNaC::ex& e : model_.must_be_defined) append_partial(e, all);
  for (unsigned i = 0; i < model_.matrix.rows(); ++i)
    for (unsigned j = 0; j < model_.matrix.cols(); ++j) append_partial(model_.matrix(i, j), all);
  result_.motion_must_be_defined = outermost(of_motion);
  result_.must_be_defined = outermost(all);
}

void Formulator::append_partial(const GiNaC::ex& e, Expressions& to) {
  for (const Expression& partial : substitution_.partial_operations(e)) {
    Expression form =
        rewriter_.with_rewritten_arguments(parts_ ? parts_->sharpened(partial) : partial);
    if (!form.is_total()) to.push_back(std::move(form));
  }
}

Expressions Formulator::outermost(const Expressions& all) {
  std::unordered_set<Expression, ExpressionHash> inner;
  for (const Expression& e : all)
    for (const Expression& operand : e.operands())
      for (const Expression& node : partial_nodes(operand)) inner.insert(node);
  Expressions result;
  for (const Expression& e : all)
    if (inner.insert(e).second) result.push_back(e);
  std::sort(result.begin(), result.end(),
            [](const Expression& a, const Expression& b) { return compare(a, b) < 0; });
  return result;
}

}  // namespace regulus::detail
