// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/part_printer.hpp"

#include <algorithm>
#include <optional>

#include "codegen/kernel/cpp/comment.hpp"
#include "codegen/kernel/cpp/constant_text.hpp"
#include "codegen/kernel/cpp/literal.hpp"
#include "codegen/kernel/cpp/operation_text.hpp"
#include "codegen/kernel/cpp/output_label.hpp"

namespace regulus::detail {
namespace {

using Pack = machine::PackOperation;

// With " const I " before it and ";" after it, this gives a line of about 100 columns.
constexpr std::size_t kMaxExpression = 76;

}  // namespace

PartPrinter::PartPrinter(const Module& module, const Function& function,
                         const SelectedFunction& selected, ValueNames& names, std::uint32_t part)
    : module_(module),
      function_(function),
      selected_(selected),
      names_(names),
      begin_(part == 0 ? 0 : selected.code.part_ends[part - 1]),
      end_(selected.code.part_ends[part]) {
  count_uses();
}

void PartPrinter::count_uses() {
  uses_.assign(end_ - begin_, 0);
  for (ValueId value = begin_; value < end_; ++value) {
    const Instruction& i = at(value);
    if (i.operation == Pack::kKeep) ++uses_[i.b - begin_];
    if (i.operation == Pack::kStore) ++uses_[i.c - begin_];
    const std::uint32_t operands[] = {i.a, i.b, i.c};
    for (int k = 0; k < machine::operand_count(i.operation); ++k) ++uses_[operands[k] - begin_];
  }
}

void PartPrinter::print() {
  const auto& marks = selected_.marks;
  auto mark = std::ranges::lower_bound(marks, begin_, {}, &SelectedFunction::Mark::instruction);
  // Marks at the beginning belong to this part, because every part has instructions.
  for (ValueId value = begin_; value < end_; ++value) {
    for (; mark != marks.end() && mark->instruction == value; ++mark) print_mark(*mark);
    print_instruction(value);
  }
}

void PartPrinter::print_mark(const SelectedFunction::Mark& mark) {
  const Step& step = selected_.plan.steps[mark.step];
  std::string text = output_label(module_, function_, step.first_output);
  if (step.last_output > step.first_output)
    text += " … " + output_label(module_, function_, step.last_output);
  if (!step.opens_group) text += ", continued";
  if (step.first_output < function_.output_comments.size()) {
    const std::string& comment = function_.output_comments[step.first_output];
    if (comment.starts_with(text))
      text = comment;
    else if (!comment.empty())
      text += ": " + comment;
  }
  statements_ += comment_lines("  ", text);
}

void PartPrinter::print_instruction(ValueId value) {
  const Instruction& i = at(value);
  switch (i.operation) {
    case Pack::kStore:
      return print_store(i);
    case Pack::kKeep:
      return print_keep(i);
    case Pack::kSinCos_I:
      return print_sine_and_cosine(value);
    case Pack::kCosine:
      return;
    case Pack::kLoad:
      usage_.boxes = true;
      return declare(value, render(value).text);
    case Pack::kPoint:
      usage_.points = true;
      return declare(value, render(value).text);
    default:
      break;
  }
  if (is_checked_constant(value)) return declare(value, render(value).text);
  ExpressionText expression = compute(value);
  if (can_wait(value))
    pending_.emplace(value, std::move(expression));
  else if (i.operation == Pack::kConstant)
    declare(value, expression.text);
  else
    define(value, expression.text);
}

/// True if the expression of the value may be written where the value is read. This holds for
/// literals and negated points. Another value must be read exactly once, in this part, and either
/// be a sum, product or sign or be read by the check that follows it.
bool PartPrinter::can_wait(ValueId value) const {
  const Instruction& i = at(value);
  const std::uint32_t uses = uses_[value - begin_];
  if (is_literal(i.operation) || i.operation == Pack::kThin_P) return true;
  if (i.operation == Pack::kNegate_P && at(i.a).operation == Pack::kPoint) return true;
  if (i.operation == Pack::kConstant) {
    const Interval& bounds = selected_.code.constants[i.a];
    if (bounds.lo == bounds.hi) return true;
  }
  if (uses != 1 || is_kept(value)) return false;
  const bool next_reads = value + 1 < end_ &&
                          (at(value + 1).operation == Pack::kChecked_IU ||
                           at(value + 1).operation == Pack::kPointOf_I) &&
                          at(value + 1).a == value;
  return next_reads || is_sign_or_product(i.operation);
}

/// True for a value that another part reads: it has a name in its own part, too.
bool PartPrinter::is_kept(ValueId value) const {
  if (value + 1 == end_) return false;
  const Instruction& next = at(value + 1);
  if (next.operation == Pack::kThin_P && next.a == value) return is_kept(value + 1);
  return next.operation == Pack::kKeep && next.b == value;
}

bool PartPrinter::is_checked_constant(ValueId value) const {
  return at(value).operation == Pack::kChecked_IU && is_pending(at(value).a) &&
         at(at(value).a).operation == Pack::kConstant;
}

ExpressionText PartPrinter::compute(ValueId value) {
  ExpressionText result = render(value);
  const Instruction& i = at(value);
  const std::uint32_t operands[] = {i.a, i.b, i.c};
  const int count = machine::operand_count(i.operation);
  while (result.text.size() > kMaxExpression) {
    std::optional<ValueId> longest;
    for (int k = 0; k < count; ++k) {
      const ValueId operand = operands[k];
      if (!is_pending(operand) || !is_sign_or_product(at(operand).operation)) continue;
      if (!longest || pending_.at(*longest).text.size() < pending_.at(operand).text.size())
        longest = operand;
    }
    if (!longest) break;
    const std::string expression = std::move(pending_.at(*longest).text);
    pending_.erase(*longest);
    define(*longest, expression);
    result = render(value);
  }
  return result;
}

ExpressionText PartPrinter::render(ValueId value) {
  const Instruction& i = at(value);
  switch (i.operation) {
    case Pack::kLoad:
      return atom(concatenate({"load(boxes, ", std::to_string(i.a), ")"}));
    case Pack::kPoint:
      return atom(concatenate({"point(points, ", std::to_string(i.a), ")"}));
    case Pack::kConstant:
      return atom(constant_literal(selected_.code.constants[i.a]));
    case Pack::kExact:
      return atom(concatenate({"P(", literal(selected_.code.constants[i.a].lo), ")"}));
    case Pack::kFetch:
      usage_.shared = true;
      return atom(concatenate({"shared[", std::to_string(i.a), "]"}));
    case Pack::kNegate_P:
    case Pack::kNegate_I:
      return negation(use(i.a));
    default:
      break;
  }
  const BinaryText sign = sign_of(i.operation);
  if (sign == nullptr) return render_call(i);
  const ExpressionText left = use(i.a);
  return sign(left, use(i.b));
}

ExpressionText PartPrinter::render_call(const Instruction& i) {
  std::string text = std::string(function_name(i.operation)) + "(" + use(i.a).text;
  const int count = machine::operand_count(i.operation);
  if (count > 1) text += ", " + use(i.b).text;
  if (count > 2) text += ", " + use(i.c).text;
  if (i.operation == Pack::kPow_IN) text += ", " + std::to_string(i.b);
  return atom(text + (marks_undefined(i.operation) ? ", undefined)" : ")"));
}

ExpressionText PartPrinter::use(ValueId value) {
  if (const auto found = pending_.find(value); found != pending_.end()) return found->second;
  return atom(named_.at(value));
}

std::string PartPrinter::name_of(ValueId value) {
  const NodeId node = selected_.nodes[value];
  return node == SelectedFunction::kNoNode ? names_.temporary() : names_.of(node);
}

void PartPrinter::define(ValueId value, const std::string& expression) {
  const std::string name = name_of(value);
  statements_ += concatenate(
      {"  const ", is_exact(at(value).operation) ? "P " : "I ", name, " = ", expression, ";\n"});
  named_[value] = name;
}

/// Declares a value at the head of the part; the comment has the source text of a constant.
void PartPrinter::declare(ValueId value, const std::string& expression) {
  const NodeId node = selected_.nodes[value];
  const bool constant = at(value).operation != Pack::kLoad && at(value).operation != Pack::kPoint;
  const std::string comment = constant && node != SelectedFunction::kNoNode
                                  ? comment_text(constant_text(function_.program, node))
                                  : std::string();
  const std::string name = name_of(value);
  declarations_ +=
      concatenate({"  const ", is_exact(at(value).operation) ? "P " : "I ", name, " = ", expression,
                   ";", comment.empty() ? "" : "  // ", comment, "\n"});
  named_[value] = name;
}

void PartPrinter::print_sine_and_cosine(ValueId value) {
  const std::string argument = use(at(value).a).text;
  const std::string sine = named_[value] = name_of(value);
  const std::string cosine = named_[value + 1] = name_of(value + 1);
  statements_ += concatenate(
      {"  I ", sine, ", ", cosine, ";\n  sincos(", argument, ", ", sine, ", ", cosine, ");\n"});
}

void PartPrinter::print_keep(const Instruction& i) {
  usage_.shared = true;
  statements_ += "  shared[" + std::to_string(i.a) + "] = " + use(i.b).text + ";\n";
}

void PartPrinter::print_store(const Instruction& i) {
  usage_.out = true;
  const std::string value = use(i.c).text;
  const std::string first = std::to_string(i.a);
  if (i.a == i.b)
    statements_ += "  store(out, " + first + ", " + value + ");\n";
  else
    statements_ += "  for (int e = " + first + "; e <= " + std::to_string(i.b) +
                   "; ++e) store(out, e, " + value + ");\n";
}

}  // namespace regulus::detail
