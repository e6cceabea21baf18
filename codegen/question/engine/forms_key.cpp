// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/forms_key.hpp"

#include <unordered_map>

#include "codegen/kernel/formulation/typical_ranges.hpp"
#include "codegen/kernel/jit/cache/key_parts.hpp"
#include "codegen/kernel/symbolic/print.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/question/engine/options_key.hpp"

namespace regulus::detail {
namespace {

/// Increase it if other data than these decide the forms.
constexpr int kFormsFormat = 1;

/// Adds expressions as lists of their nodes, each node once, operands first.
class ExpressionKey {
 public:
  explicit ExpressionKey(KeyParts& parts) : parts_(parts) {}

  void add(const Expressions& expressions) {
    parts_.begin_list(expressions.size());
    for (const Expression& e : expressions) {
      const std::size_t number = number_of(e);
      parts_.add("=");
      parts_.add(static_cast<long long>(number));
    }
  }

 private:
  std::size_t number_of(const Expression& e) {
    if (const auto known = numbers_.find(e); known != numbers_.end()) return known->second;
    std::vector<std::size_t> operands;
    for (const Expression& operand : e.operands()) operands.push_back(number_of(operand));
    parts_.add(static_cast<int>(e.kind()));
    add_content(e);
    parts_.begin_list(operands.size());
    for (const std::size_t operand : operands) parts_.add(static_cast<long long>(operand));
    return numbers_.emplace(e, numbers_.size()).first->second;
  }

  void add_content(const Expression& e) {
    switch (e.kind()) {
      case ExpressionKind::kConstant:
        return parts_.add(to_string(e));
      case ExpressionKind::kPoint:
      case ExpressionKind::kVariable:
        return parts_.add(e.name());
      case ExpressionKind::kPower:
        return parts_.add(e.exponent());
      case ExpressionKind::kCall:
        return parts_.add(static_cast<int>(e.function()));
      case ExpressionKind::kNumberPi:
      case ExpressionKind::kProduct:
      case ExpressionKind::kSum:
        return;
    }
  }

  KeyParts& parts_;
  std::unordered_map<Expression, std::size_t, ExpressionHash> numbers_;
};

/// The middle of an uncertain quantity's range is a constant of the expansion.
void add(KeyParts& parts, const std::vector<Variable>& variables) {
  const std::vector<Variable> typical = with_typical_ranges(variables);
  parts.begin_list(variables.size());
  for (std::size_t k = 0; k < variables.size(); ++k) {
    const auto& [name, unit, kind, range, ball] = variables[k];
    parts.add(name);
    parts.add(static_cast<int>(kind));
    parts.add(ball);
    parts.add(formula_text(typical[k].range.lo));
    parts.add(formula_text(typical[k].range.hi));
    if (kind != VariableKind::kMotion) parts.add(formula_text((range.lo + range.hi) / 2));
  }
}

}  // namespace

std::string forms_key(const Formulation& natural, bool has_threshold,
                      const FormulationOptions& functions, Isa isa, std::string_view program,
                      std::string_view compiler) {
  KeyParts parts;
  parts.add("forms");
  parts.add(kFormsFormat);
  parts.add(program);
  parts.add(compiler);
  parts.add(name(isa));
  add(parts, functions);
  parts.add(has_threshold);
  parts.add(natural.rows);
  parts.add(natural.columns);
  add(parts, natural.variables);
  ExpressionKey expressions(parts);
  for (const Expressions* part : {&natural.natural_matrix, &natural.natural_row_scale,
                                  &natural.row_scale, &natural.constraints, &natural.pose,
                                  &natural.must_be_defined, &natural.motion_must_be_defined})
    expressions.add(*part);
  return parts.key();
}

}  // namespace regulus::detail
