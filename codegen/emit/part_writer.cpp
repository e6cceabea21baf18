// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/emit/part_writer.hpp"

#include "regulus/codegen/emit/comment.hpp"
#include "regulus/codegen/emit/output_label.hpp"

namespace regulus::codegen {
namespace {

bool is_arithmetic(const Node& node) {
  switch (node.op) {
    case Op::kNegate:
    case Op::kAdd:
    case Op::kSubtract:
    case Op::kMultiply:
      return true;
    case Op::kPower:
      return node.index == 2;
    default:
      return false;
  }
}

int highest_bit(std::uint32_t n) {
  int bit = 0;
  while (n >>= 1) ++bit;
  return bit;
}

}  // namespace

PartWriter::PartWriter(const Module& module, const Function& function, const FunctionPlan& plan,
                       ValueNames& names, std::uint32_t part)
    : module_(module),
      function_(function),
      plan_(plan),
      names_(names),
      part_(part),
      named_(function.program.nodes.size(), false) {}

void PartWriter::write() {
  const Part& part = plan_.parts[part_];
  find_partners(part);
  for (std::size_t i = part.first_step; i < part.last_step; ++i) {
    const Step& step = plan_.steps[i];
    if (step.opens_group || i == part.first_step) write_group_comment(step);
    if (step.kind == Step::Kind::kCompute)
      write_compute(step.node);
    else
      write_store(step);
  }
}

/// A sine and a cosine of one argument cost one call when the same part computes both.
void PartWriter::find_partners(const Part& part) {
  std::map<NodeId, NodeId> first_of;
  for (std::size_t i = part.first_step; i < part.last_step; ++i) {
    const NodeId id = plan_.steps[i].node;
    if (plan_.steps[i].kind != Step::Kind::kCompute) continue;
    if (node(id).op != Op::kSin && node(id).op != Op::kCos) continue;
    const auto [entry, is_first] = first_of.try_emplace(node(id).a, id);
    if (is_first) continue;
    partner_[id] = entry->second;
    partner_[entry->second] = id;
  }
}

void PartWriter::write_group_comment(const Step& step) {
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

void PartWriter::write_compute(NodeId id) {
  if (named_[id]) return;
  if (write_sine_and_cosine(id)) return;
  if (node(id).op == Op::kPower && plan_.magnitudes.needs_check[id]) return write_checked_power(id);
  ExpressionText expression = compute(id);
  if (can_be_deferred(id))
    deferred_.emplace(id, std::move(expression));
  else
    define(id, expression.text);
}

bool PartWriter::can_be_deferred(NodeId id) const {
  return plan_.uses[id] == 1 && plan_.last_part_of[id] == part_ && is_arithmetic(node(id)) &&
         !plan_.magnitudes.needs_check[id];
}

bool PartWriter::write_sine_and_cosine(NodeId id) {
  const auto partner = partner_.find(id);
  if (partner == partner_.end()) return false;
  const NodeId sine = node(id).op == Op::kSin ? id : partner->second;
  const NodeId cosine = node(id).op == Op::kSin ? partner->second : id;
  const std::string argument = as_interval(node(id).a);
  const std::string sine_name = names_.of(sine);
  const std::string cosine_name = names_.of(cosine);
  statements_ += concatenate({"  I ", sine_name, ", ", cosine_name, ";\n  sincos(", argument, ", ",
                              sine_name, ", ", cosine_name, ");\n"});
  for (const NodeId both : {sine, cosine}) {
    named_[both] = true;
    keep_for_later_parts(both);
  }
  return true;
}

/// A power that may overflow, by squaring, each step checked: inside pow an infinite factor could
/// meet a 0.
void PartWriter::write_checked_power(NodeId id) {
  const NodeId a = node(id).a;
  const std::uint32_t n = node(id).index;
  if (is_deferred(a)) define_deferred(a);
  const std::string base = as_interval(a);
  std::string value = base;
  std::string expression;
  const auto step = [&](const std::string& next) {
    if (!expression.empty()) {
      value = names_.temporary();
      statements_ += "  const I " + value + " = checked(" + expression + ", undefined);\n";
    }
    expression = next;
  };
  for (int bit = highest_bit(n) - 1; bit >= 0; --bit) {
    step({});
    expression = "sqr(" + value + ")";
    if ((n >> bit) & 1U) {
      step({});
      expression = value + " * " + base;
    }
  }
  define(id, expression);
}

void PartWriter::define(NodeId id, const std::string& expression) {
  const bool check = plan_.magnitudes.needs_check[id];
  statements_ += concatenate({"  const ", is_interval(id) ? "I " : "P ", names_.of(id), " = "}) +
                 (check ? "checked(" + expression + ", undefined)" : expression) + ";\n";
  named_[id] = true;
  keep_for_later_parts(id);
}

void PartWriter::define_deferred(NodeId id) {
  const std::string expression = std::move(deferred_.at(id).text);
  deferred_.erase(id);
  define(id, expression);
}

void PartWriter::keep_for_later_parts(NodeId id) {
  if (plan_.slots[id] == kNoSlot) return;
  usage_.shared = true;
  const std::string name = is_interval(id) ? names_.of(id) : "thin(" + names_.of(id) + ")";
  statements_ += "  shared[" + std::to_string(plan_.slots[id]) + "] = " + name + ";\n";
}

void PartWriter::write_store(const Step& step) {
  usage_.out = true;
  const std::string value = as_interval(step.node);
  const std::string first = std::to_string(step.first_output);
  const std::string last = std::to_string(step.last_output);
  if (first == last)
    statements_ += "  store(out, " + first + ", " + value + ");\n";
  else
    statements_ +=
        "  for (int e = " + first + "; e <= " + last + "; ++e) store(out, e, " + value + ");\n";
}

void PartWriter::declare(NodeId id, const std::string& type, const std::string& expression,
                         const std::string& comment) {
  if (named_[id]) return;
  named_[id] = true;
  const std::string text = comment_text(comment);
  declarations_ += "  const " + type + " " + names_.of(id) + " = " + expression + ";" +
                   (text.empty() ? "" : "  // " + text) + "\n";
}

}  // namespace regulus::codegen
