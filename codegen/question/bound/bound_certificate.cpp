// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/bound_certificate.hpp"

#include <fmt/format.h>

#include "codegen/answer/certificate/certificate_expression_writer.hpp"
#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/certificate/load_question.hpp"
#include "codegen/model/mechanism/twist.hpp"
#include "codegen/question/quantity/quantity_traits.hpp"
#include "runtime/proof/format.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

/// A quantity that is never negative has the side of its end, not that of an absolute value.
const char* side_of(const Component& c) {
  const QuantityTraits& traits = traits_of(c.kind);
  if (traits.is_always_least) return format::kLeast;
  if (traits.is_never_negative || c.part != PosePart::kColumn) return format::kLargest;
  if (c.is_absolute) return format::kAbsolute;
  return c.sign < 0 ? format::kLeast : format::kLargest;
}

class BoundText {
 public:
  BoundText(const Model& model, const Component& component, const Bordered& bordered)
      : model_(model), c_(component), traits_(traits_of(component.kind)), bordered_(bordered) {}

  std::string text(const ex& end) {
    put("quantity", words_.quantity = traits_.certified);
    put("side", words_.side = side_of(c_));
    const bool has_pairs = traits_.components == ComponentsOf::kPairs;
    if (has_pairs || traits_.components == ComponentsOf::kRows)
      put("row", words_.row = std::to_string(c_.row + 1));
    if (has_pairs || traits_.components == ComponentsOf::kFreedoms ||
        traits_.components == ComponentsOf::kNorms)
      put("column", words_.columns = columns());
    if (c_.set != nullptr) write_set();
    if (traits_.data == NeededData::kMotorErrors)
      put_each_row("motor-error", model_.actuators.error, "0");
    if (traits_.data == NeededData::kLoadAndStiffness)
      put_each_row("stiffness", model_.actuators.stiffness, format::kRigid);
    if (traits_.compares_units) write_factors();
    if (bordered_.combination) write_combination();
    if (c_.expression) write_expression();
    put("reference", expression_text(bordered_.reference));
    write_bound(end);
    return std::move(text_);
  }

  /// After text().
  [[nodiscard]] const format::ClaimedBound& words() const { return words_; }

 private:
  void put(const std::string& key, const std::string& value) { text_ += key + ' ' + value + '\n'; }

  void put_each(const std::string& key, const std::vector<ex>& values) {
    for (const ex& value : values) put(key, expression_text(value));
  }

  /// The rows of constraints are not in the list.
  void put_each_row(const std::string& key, const std::vector<ex>& values,
                    const char* of_constraint) {
    put_each(key, values);
    for (std::size_t i = values.size(); i < model_.matrix.rows(); ++i) put(key, of_constraint);
  }

  /// Returns the number of the column, or of each column of the part of the pose.
  [[nodiscard]] std::string columns() const {
    if (c_.part == PosePart::kColumn) return std::to_string(c_.column + 1);
    const auto kind = c_.part == PosePart::kLinear ? TwistComponent::Kind::kLinear
                                                   : TwistComponent::Kind::kAngular;
    const std::vector<TwistComponent> twist = twist_of(model_);
    std::string numbers;
    for (std::size_t j = 0; j < twist.size(); ++j)
      if (twist[j].kind == kind) numbers += (numbers.empty() ? "" : " ") + std::to_string(j + 1);
    return numbers;
  }

  void write_set() {
    put(traits_.data == NeededData::kTwist ? "twist" : "load", words_.set = c_.set->name);
    text_ += vector_lines(*c_.set);
    if (bordered_.has_norms) text_ += "norms\n";
  }

  /// Writes 1 for a velocity and 1/L for an angular velocity.
  void write_factors() {
    const std::vector<TwistComponent> twist = twist_of(model_);
    for (unsigned j = 0; j < model_.matrix.cols(); ++j) {
      const bool is_angle = j < twist.size() && twist[j].kind == TwistComponent::Kind::kAngular;
      put("factor", is_angle && model_.characteristic_length
                        ? expression_text(1 / *model_.characteristic_length)
                        : "1");
    }
  }

  void write_combination() {
    const GiNaC::matrix& C = *bordered_.combination;
    for (unsigned i = 0; i < C.rows(); ++i) {
      text_ += "combined";
      for (unsigned j = 0; j < C.cols(); ++j) text_ += ' ' + expression_text(C(i, j));
      text_ += '\n';
    }
  }

  void write_expression() {
    put("expression", words_.expression = expression_text(*c_.expression));
    put_each("expression-defined", c_.must_be_defined);
  }

  void write_bound(const ex& end) {
    if (bordered_.is_reciprocal && end.is_zero()) {
      text_ += "unbounded\n";
      return;
    }
    const ex bound = bordered_.is_reciprocal ? ex(c_.sign * (bordered_.reference + 1 / end)) : end;
    put("bound", words_.bound = expression_text(bound));
  }

  const Model& model_;
  const Component& c_;
  const QuantityTraits& traits_;
  const Bordered& bordered_;
  format::ClaimedBound words_;
  std::string text_;
};

}  // namespace

CertifiedQuestion certified_bound(const Request& request, const Component& component,
                                  const Bordered& bordered, const ex& end,
                                  const std::set<std::string>& uncertain) {
  Request plain = request;
  plain.motion.alpha = 0;
  std::set<std::string> own;
  for (const GeometryParameter& g : plain.model.geometry)
    if (uncertain.contains(g.name)) own.insert(g.name);
  for (const PoseParameter& p : plain.model.pose)
    if (uncertain.contains(p.name)) own.insert(p.name);
  CertifiedQuestion question = certified_question(plain, own);
  BoundText bound(plain.model, component, bordered);
  question.text += bound.text(end);
  const format::ClaimedSet set = claimed_set(plain, own);
  question.no_singularity = format::describe_bound_claim(set, bound.words(), false);
  question.singularity = format::describe_bound_claim(set, bound.words(), true);
  return question;
}

}  // namespace regulus::detail
